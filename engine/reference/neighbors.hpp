#pragma once
// Who is within the kernel's support of whom: all pairs of a small cloud, a hash grid of cells of edge h for a larger one.
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rill::reference {

/// Neighbors of particle i, itself left out, in rising order: j[first[i]] .. j[first[i + 1] - 1]. Nothing is truncated.
struct Neighbors {
  std::vector<uint32_t> first;
  std::vector<uint32_t> j;

  std::span<const uint32_t> of(size_t i) const { return std::span(j).subspan(first[i], first[i + 1] - first[i]); }
};

/// All pairs with |x_i - x_j| < h (m, > 0). Positions are finite.
Neighbors findNeighbors(std::span<const glm::dvec3> x, double h);

/// The same by looking at every pair: the oracle of the grid.
Neighbors findNeighborsBruteForce(std::span<const glm::dvec3> x, double h);

}  // namespace rill::reference
