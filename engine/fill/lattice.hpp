#pragma once
// Particle lattices of box, sphere and mesh fills.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rill/scene.hpp"

namespace rill {

class TriangleTree;

/// Indices of consecutive points of a row.
struct Run {
  uint64_t begin = 0, end = 0;  ///< [begin, end)
};

/// A box, sphere or mesh fill at a given spacing. Points are at first + index x spacing on each axis.
struct Lattice {
  Double3 first = {0, 0, 0};                      ///< m, scene coordinates of the first point
  Double3 size = {0, 0, 0};                       ///< points along each axis: whole numbers, as doubles since they may exceed 64 bits
  double spacing = 0;                             ///< m
  double radius = -1;                             ///< m, of the sphere centered on the lattice; negative: a box or a mesh
  std::shared_ptr<const TriangleTree> mesh = {};  ///< in scene coordinates
  double volume = 0;                              ///< m^3, of the mesh

  double boxCount() const { return size[0] * size[1] * size[2]; }
};

/// The lattice of a fill's box, sphere or mesh.
Lattice latticeOf(const Fill& fill, double spacing);

/// Number of lattice points inside the fill. Exact for boxes, and for spheres and meshes of at most `exactRows` rows of points; larger
/// ones are estimated by volume, to about 1 in 1000.
double countPoints(const Lattice& lattice, double exactRows);

/// The points of row (j, k) inside the fill, in order.
std::vector<Run> rowOf(const Lattice& lattice, uint64_t j, uint64_t k);

/// The spacing (m) at which the lattices of `fills` have about `target` points and fit their boxes: within 2 % of the closest count that
/// any spacing gives. 0 if no fill is a box, a sphere or a mesh. Deterministic.
double spacingFor(std::span<const Fill> fills, double target);

}  // namespace rill
