#include "offline/neighbor_counter.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace rill::offline {

NeighborCounter::NeighborCounter(std::span<const Float3> points, double radius) : points_(points), radius_(radius) {
  assert(radius > 0 && points.size() < (1u << 31));
  const uint32_t buckets = std::bit_ceil(std::max<uint32_t>(1, static_cast<uint32_t>(points.size())));
  mask_ = buckets - 1;
  start_.assign(buckets + 1, 0);
  std::vector<uint32_t> bucket(points.size(), UINT32_MAX);
  for (size_t i = 0; i < points.size(); ++i) {
    Cell cell;
    if (!cellOf(points[i], cell)) continue;
    bucket[i] = bucketOf(cell);
    ++start_[bucket[i] + 1];
  }
  for (uint32_t b = 0; b < buckets; ++b) start_[b + 1] += start_[b];
  entries_.resize(start_[buckets]);
  std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
  for (uint32_t i = 0; i < points.size(); ++i)
    if (bucket[i] != UINT32_MAX) entries_[next[bucket[i]]++] = i;
}

uint32_t NeighborCounter::count(uint32_t index, uint32_t maxCount) const {
  Cell home;
  if (!cellOf(points_[index], home)) return 0;
  const Float3 center = points_[index];
  uint32_t found = 0;
  for (int64_t z = -1; z <= 1; ++z)
    for (int64_t y = -1; y <= 1; ++y)
      for (int64_t x = -1; x <= 1; ++x) {
        const Cell cell{home[0] + x, home[1] + y, home[2] + z};
        const uint32_t bucket = bucketOf(cell);
        for (uint32_t e = start_[bucket]; e < start_[bucket + 1]; ++e) {
          const uint32_t other = entries_[e];
          Cell otherCell;
          // Cells may share a bucket: compare cells, so that no point is counted twice.
          if (other == index || !cellOf(points_[other], otherCell) || otherCell != cell) continue;
          const double dx = double(points_[other].x) - center.x, dy = double(points_[other].y) - center.y,
                       dz = double(points_[other].z) - center.z;
          if (dx * dx + dy * dy + dz * dz <= radius_ * radius_ && ++found >= maxCount) return found;
        }
      }
  return found;
}

bool NeighborCounter::cellOf(const Float3& point, Cell& cell) const {
  const Double3 value = {point.x / radius_, point.y / radius_, point.z / radius_};
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(std::abs(value[axis]) < 1e15)) return false;  // also for NaN and infinity
    cell[axis] = static_cast<int64_t>(std::floor(value[axis]));
  }
  return true;
}

uint32_t NeighborCounter::bucketOf(const Cell& cell) const {
  uint64_t h = 0x9e3779b97f4a7c15ull;
  for (const int64_t c : cell) {
    h ^= static_cast<uint64_t>(c);
    h *= 0xff51afd7ed558ccdull;
    h ^= h >> 32;
  }
  return static_cast<uint32_t>(h) & mask_;
}

}  // namespace rill::offline
