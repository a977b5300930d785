#pragma once
// A tree of bounding boxes over triangles: the nearest point, the winding number, rays. Points and lengths in m, in the mesh's frame.
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "rill/vectors.hpp"

namespace rill {

using Triangle = std::array<uint32_t, 3>;

/// The point of a surface that is nearest to another point.
struct NearestPoint {
  double squared = std::numeric_limits<double>::infinity();  ///< of the distance, m^2
  Double3 point = {0, 0, 0};
  uint32_t triangle = 0;  ///< for a further search near by
};

/// Where the surface crosses a line along +x, and by how much the winding number falls there.
struct Crossing {
  double x = 0;
  int sign = 0;
};

class TriangleTree {
 public:
  TriangleTree(const std::vector<Double3>& vertices, const std::vector<Triangle>& triangles);

  /// The nearest point; infinitely far if there are no triangles. `guess`: a triangle that may be near, which makes the search faster.
  NearestPoint nearest(const Double3& at, uint32_t guess = 0) const;

  /// The crossings of the line through `at` along x, unordered. Triangles that share an edge never both miss or both hit a line through
  /// it: the line counts as moved by a vanishing amount along +y, and by less along +z.
  void crossings(const Double3& at, std::vector<Crossing>& out) const;

  /// How often the surface winds around a point; 0 outside. Exact for closed meshes, but for points on the surface.
  int winding(const Double3& at) const;

  /// Distance along a ray (unit direction) to the first triangle, m.
  std::optional<double> firstHit(const Double3& from, const Double3& along) const;

 private:
  using Corners = std::array<Double3, 3>;
  /// Bounds of `count` triangles from `first` on. An inner node has none of its own; its children are `child` and `child + 1`.
  struct Node {
    Double3 low, high;
    uint32_t first = 0, count = 0;
    uint32_t child = 0;
  };
  void build(uint32_t node, uint32_t first, uint32_t count);
  /// Replaces `best` if this triangle is nearer.
  void take(uint32_t triangle, const Double3& at, NearestPoint& best) const;

  std::vector<Corners> triangles_;  // in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace rill
