#include "reference/neighbors.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace rill::reference {
namespace {

constexpr size_t kMaxBruteForce = 64;

struct Cell {
  int64_t x, y, z;
};

Cell cellOf(const glm::dvec3& x, double h) {
  return {static_cast<int64_t>(std::floor(x.x / h)), static_cast<int64_t>(std::floor(x.y / h)), static_cast<int64_t>(std::floor(x.z / h))};
}

/// 21 bits per axis. Cells that are 2^21 apart share a key, which only adds distance tests.
uint64_t keyOf(const Cell& c) {
  constexpr uint64_t mask = (1u << 21) - 1;
  return (static_cast<uint64_t>(c.x) & mask) << 42 | (static_cast<uint64_t>(c.y) & mask) << 21 | (static_cast<uint64_t>(c.z) & mask);
}

bool within(const glm::dvec3& a, const glm::dvec3& b, double h) {
  const glm::dvec3 r = a - b;
  return glm::dot(r, r) < h * h;
}

}  // namespace

Neighbors findNeighborsBruteForce(std::span<const glm::dvec3> x, double h) {
  Neighbors found;
  found.first.push_back(0);
  for (uint32_t i = 0; i < x.size(); ++i) {
    for (uint32_t j = 0; j < x.size(); ++j)
      if (j != i && within(x[i], x[j], h)) found.j.push_back(j);
    found.first.push_back(static_cast<uint32_t>(found.j.size()));
  }
  return found;
}

Neighbors findNeighbors(std::span<const glm::dvec3> x, double h) {
  if (x.size() <= kMaxBruteForce) return findNeighborsBruteForce(x, h);
  std::unordered_map<uint64_t, std::vector<uint32_t>> cells;
  for (uint32_t i = 0; i < x.size(); ++i) cells[keyOf(cellOf(x[i], h))].push_back(i);
  Neighbors found;
  found.first.push_back(0);
  for (uint32_t i = 0; i < x.size(); ++i) {
    const Cell home = cellOf(x[i], h);
    for (int64_t dx = -1; dx <= 1; ++dx)
      for (int64_t dy = -1; dy <= 1; ++dy)
        for (int64_t dz = -1; dz <= 1; ++dz) {
          const auto cell = cells.find(keyOf({home.x + dx, home.y + dy, home.z + dz}));
          if (cell == cells.end()) continue;
          for (const uint32_t j : cell->second)
            if (j != i && within(x[i], x[j], h)) found.j.push_back(j);
        }
    std::sort(found.j.begin() + found.first.back(), found.j.end());
    found.first.push_back(static_cast<uint32_t>(found.j.size()));
  }
  return found;
}

}  // namespace rill::reference
