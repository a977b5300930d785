#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rill/float3.hpp"

namespace rill::offline {

/// Counts points near one of them, on the host. A hash grid with cells of the radius: cost follows the points, not the room they span.
/// Points with a coordinate that is not finite are nobody's neighbor.
class NeighborCounter {
 public:
  /// Keeps the span: `points` outlives the counter. `radius` > 0, m.
  NeighborCounter(std::span<const Float3> points, double radius);

  /// Other points within the radius (inclusive) of point `index`, counted no further than `enough`.
  uint32_t count(uint32_t index, uint32_t enough = UINT32_MAX) const;

 private:
  using Cell = std::array<int64_t, 3>;
  bool cellOf(const Float3& point, Cell& cell) const;
  uint32_t bucketOf(const Cell& cell) const;

  std::span<const Float3> points_;
  double radius_;
  uint32_t mask_ = 0;              ///< buckets - 1, a power of two less one
  std::vector<uint32_t> start_;    ///< first entry of each bucket, one more at the end
  std::vector<uint32_t> entries_;  ///< point indices by bucket
};

}  // namespace rill::offline
