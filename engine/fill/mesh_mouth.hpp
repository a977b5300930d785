#pragma once
// Mouths that are flat meshes, in their plane.
#include <array>
#include <utility>
#include <vector>

#include "rill/scene.hpp"

namespace rill {

/// A point of the plane of a mouth, m, along `across` and `up` from its center.
using MouthPoint = std::array<double, 2>;

/// A mesh mouth in scene coordinates, and its triangles in its plane.
struct FlatMouth {
  Double3 center = {0, 0, 0};  ///< centroid, m
  Double3 normal = {0, 0, 0}, across = {0, 0, 0},
          up = {0, 0, 0};  ///< unit vectors; across = normal x up, along the longest edge of the outline
  double area = 0;         ///< m^2
  std::vector<std::array<MouthPoint, 3>> triangles = {};
  std::vector<std::array<MouthPoint, 2>> outline = {};  ///< edges of one triangle
  MouthPoint low = {0, 0}, high = {0, 0};               ///< bounds
};
FlatMouth flatMouth(const MeshMouth& mouth);

/// The points of a lattice in its triangles. Of a point on an edge, one of the two has it.
struct MouthGrid {
  MouthPoint pitch = {0, 0}, first = {0, 0};  ///< m; `first`: any point of the lattice
};
/// The number of these points, and the sum of their places, m. Points in several triangles count several times.
struct MouthSum {
  double count = 0;
  MouthPoint moment = {0, 0};
};
MouthSum sumIn(const FlatMouth& mouth, const MouthGrid& grid);
/// Each once, by rows from low `up`; `shared`: how many were left out.
std::vector<MouthPoint> pointsIn(const FlatMouth& mouth, const MouthGrid& grid, size_t* shared = nullptr);
/// How many pairs of a triangle and a row of a lattice these take.
double rowsOf(const FlatMouth& mouth, double pitch);

/// The middle of the largest triangle.
MouthPoint middleOf(const FlatMouth& mouth);

/// m, scene coordinates.
Double3 inScene(const FlatMouth& mouth, const MouthPoint& point);

}  // namespace rill
