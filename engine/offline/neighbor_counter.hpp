#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rill/vectors.hpp"

namespace rill::offline {

/// Counts neighbors on the host, with a hash grid whose cost does not depend on the extent of the points. Non-finite points have no
/// neighbors.
class NeighborCounter {
 public:
  /// `points` must outlive the counter. `radius`: m, > 0.
  NeighborCounter(std::span<const Float3> points, double radius);

  /// Number of other points within the radius (inclusive) of point `index`, at most `maxCount`.
  uint32_t count(uint32_t index, uint32_t maxCount = UINT32_MAX) const;

 private:
  using Cell = std::array<int64_t, 3>;
  bool cellOf(const Float3& point, Cell& cell) const;
  uint32_t bucketOf(const Cell& cell) const;

  std::span<const Float3> points_;
  double radius_;
  uint32_t mask_ = 0;              ///< number of buckets - 1; the number is a power of two
  std::vector<uint32_t> start_;    ///< first entry of each bucket, and the number of entries
  std::vector<uint32_t> entries_;  ///< point indices by bucket
};

}  // namespace rill::offline
