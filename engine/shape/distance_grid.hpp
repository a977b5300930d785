#pragma once
// Signed distances from a mesh at the nodes of a grid that is fine near the surface. Lengths in m, in the mesh's frame.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "rill/mesh.hpp"

namespace rill {

/// Where distances are sampled finely: from `inside` within the surface to `outside` off it, m.
struct DistanceBand {
  double inside = 0, outside = 0;
};

/// Cubic blocks of kCells cells a side. All have distances at their corners; those that may meet the band also at the nodes of their cells.
struct DistanceGrid {
  static constexpr uint32_t kCells = 4, kNodes = kCells + 1, kBlockNodes = kNodes * kNodes * kNodes;
  static constexpr uint32_t kCoarse = ~0u;

  Double3 low = {};  ///< of the first block
  double cell = 0;
  std::array<uint32_t, 3> blocks = {};
  std::vector<float> corners;  ///< of (blocks.x + 1) x (blocks.y + 1) x (blocks.z + 1) corners, x first
  std::vector<uint32_t> fine;  ///< of each block, x first: which of those with nodes it is; kCoarse: it has none
  std::vector<float> nodes;    ///< kBlockNodes for each block with nodes, x first

  double block() const { return kCells * cell; }
  size_t blockCount() const { return size_t{blocks[0]} * blocks[1] * blocks[2]; }
  /// The distance at a node of the whole grid, by its numbers along the axes: interpolated in blocks without nodes, and as far outside as
  /// the grid's border where there is no block.
  double at(const std::array<int64_t, 3>& node) const;
};

/// Words of 32 bits that a grid of this cell needs at least: those of its blocks and corners.
double gridWords(const Mesh& mesh, double cell, const DistanceBand& band);

/// `shell`: subtracted from all distances, which makes a body of a sheet. Nothing where it takes more than `maxNodes` fine nodes.
std::optional<DistanceGrid> sampleDistances(const Mesh& mesh, double cell, const DistanceBand& band, double shell, uint64_t maxNodes);

}  // namespace rill
