#pragma once
// The edges of triangles, those between the same two vertices beside each other.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shape/triangle_tree.hpp"

namespace rill {

/// An edge of a triangle, with its smaller vertex first.
struct MeshEdge {
  uint32_t low = 0, high = 0;
  uint32_t triangle = 0;
  uint32_t corner = 0;   ///< of the triangle, from which the edge runs to the next
  bool forward = false;  ///< it runs from `low` to `high`
};

inline std::vector<MeshEdge> sortedEdges(std::span<const Triangle> triangles) {
  std::vector<MeshEdge> edges;
  edges.reserve(3 * triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  std::ranges::sort(edges, {}, [](const MeshEdge& e) { return std::array{e.low, e.high, e.triangle}; });
  return edges;
}

/// Calls visit(span of the edges between the same two vertices) until it returns false.
template <class Visit>
void forEachGroup(const std::vector<MeshEdge>& edges, const Visit& visit) {
  for (size_t first = 0, end = 0; first < edges.size(); first = end) {
    for (end = first; end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high;) ++end;
    if (!visit(std::span(edges).subspan(first, end - first))) return;
  }
}

}  // namespace rill
