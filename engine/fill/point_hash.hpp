#pragma once
// Spatial hash that finds whether points are close to each other.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rill {

/// Points hashed by cell. Results do not depend on the order of insertion.
class PointHash {
 public:
  /// `reach`: largest query distance, > 0. `expected`: number of points to reserve.
  PointHash(double reach, uint64_t expected) : cell_(2 * reach), heads_(std::bit_ceil(std::max<uint64_t>(16, expected)), kNone) {
    points_.reserve(expected);
  }

  void insert(const Double3& p, uint32_t group) {
    int64_t cell[3];
    for (int axis = 0; axis < 3; ++axis) cell[axis] = index(p[axis] / cell_);
    uint32_t& head = heads_[slot(cell[0], cell[1], cell[2])];
    points_.push_back({{p[0], p[1], p[2]}, group, head});
    head = static_cast<uint32_t>(points_.size() - 1);
  }

  /// Whether a point of another group is closer than `otherGroup` to p, or one of the same group closer than `sameGroup`.
  bool overlaps(const Double3& p, uint32_t group, double otherGroup, double sameGroup) const {
    // Cells are two reaches wide: the cell of p and its neighbor on the closer side cover the reach on each axis.
    int64_t low[3];
    for (int axis = 0; axis < 3; ++axis) low[axis] = index(p[axis] / cell_ - 0.5);
    for (int corner = 0; corner < 8; ++corner) {
      for (uint32_t i = heads_[slot(low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2))]; i != kNone;
           i = points_[i].next) {
        const Point& other = points_[i];
        const double x = other.at[0] - p[0], y = other.at[1] - p[1], z = other.at[2] - p[2];
        const double limit = other.group == group ? sameGroup : otherGroup;
        if (x * x + y * y + z * z < limit * limit) return true;
      }
    }
    return false;
  }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  struct Point {
    Double3 at;
    uint32_t group, next;
  };

  /// Cells beyond the range of the index share the outermost one.
  static int64_t index(double cells) {
    constexpr double kFarthest = 1e15;
    return static_cast<int64_t>(std::floor(std::clamp(cells, -kFarthest, kFarthest)));
  }

  size_t slot(int64_t x, int64_t y, int64_t z) const {
    uint64_t h = static_cast<uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^ static_cast<uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL ^
                 static_cast<uint64_t>(z) * 0x165667B19E3779F9ULL;
    h = (h ^ (h >> 32)) * 0xD6E8FEB86659FD93ULL;
    return static_cast<size_t>((h ^ (h >> 32)) & (heads_.size() - 1));
  }

  double cell_;
  std::vector<uint32_t> heads_;
  std::vector<Point> points_;
};

}  // namespace rill
