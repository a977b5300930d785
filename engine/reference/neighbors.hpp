#pragma once
// Neighbor search: brute force for few particles, a hash grid with cells of size h for more.
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rill::reference {

/// Neighbors of particle i without i itself, in increasing order: j[first[i]] .. j[first[i + 1] - 1]. Not truncated.
struct Neighbors {
  std::vector<uint32_t> first;
  std::vector<uint32_t> j;

  std::span<const uint32_t> of(size_t i) const { return std::span(j).subspan(first[i], first[i + 1] - first[i]); }
};

/// All pairs with |x_i - x_j| < h (m, > 0). Positions must be finite.
Neighbors findNeighbors(std::span<const glm::dvec3> x, double h);

/// The same by brute force, to test the grid.
Neighbors findNeighborsBruteForce(std::span<const glm::dvec3> x, double h);

}  // namespace rill::reference
