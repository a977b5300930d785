#include "reference/images.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rill::reference {
namespace {

struct LineImage {
  double sign = 1, offset = 0;
};

/// Walls that face each other reflect images again and again: as often as the widest kernel reaches across a layer.
std::vector<LineImage> imagesOnLine(double lo, double hi) {
  constexpr int kReflections = 4;
  const bool both = std::isfinite(lo) && std::isfinite(hi);
  std::vector<LineImage> images = {{1, 0}};
  for (int k = 1; k <= (both ? kReflections : 1); ++k)
    for (const double wall : {lo, hi}) {
      if (!std::isfinite(wall)) continue;
      const double across = both ? (wall == lo ? lo - hi : hi - lo) : 0;
      if (k % 2 == 0)
        images.push_back({1, k * across});
      else
        images.push_back({-1, 2 * wall + (k - 1) * across});
    }
  return images;
}

/// How far `x` is outside the walls.
double outside(double x, double lo, double hi) { return std::max({0.0, lo - x, x - hi}); }

}  // namespace

std::vector<Image> imagesNear(const glm::dvec3& x, const Walls& walls, double reach) {
  const glm::dvec3 &lo = walls.lo, &hi = walls.hi;
  std::vector<Image> images;
  for (const LineImage& a : imagesOnLine(lo.x, hi.x))
    for (const LineImage& b : imagesOnLine(lo.y, hi.y))
      for (const LineImage& c : imagesOnLine(lo.z, hi.z)) {
        const Image image{{a.sign, b.sign, c.sign}, {a.offset, b.offset, c.offset}};
        if (image.sign == glm::dvec3(1) && image.offset == glm::dvec3(0)) continue;
        const glm::dvec3 at = image.of(x);
        bool absent = false;
        for (int axis = 0; axis < 3; ++axis)
          absent |= (at[axis] < lo[axis] && walls.isOutflow(axis, false, x)) || (at[axis] > hi[axis] && walls.isOutflow(axis, true, x));
        if (absent) continue;
        glm::dvec3 gap;
        for (int axis = 0; axis < 3; ++axis) gap[axis] = outside(at[axis], lo[axis] + walls.margin, hi[axis] - walls.margin);
        if (glm::length(gap) < reach) images.push_back(image);
      }
  return images;
}

}  // namespace rill::reference
