#include "reference/images.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace rill::reference {
namespace {

struct LineImage {
  double sign = 1, offset = 0, gap = 0;  // of an axis; gap: from the image of a point to where centers can be, m
};

/// How far `x` is outside the walls.
double outside(double x, double lo, double hi) { return std::max({0.0, lo - x, x - hi}); }

/// Images along one axis that are within reach, the identity first.
struct LineImages {
  // Walls that face each other reflect images again and again: as often as the widest kernel reaches across a layer.
  static constexpr int kReflections = 4;
  std::array<LineImage, 1 + 2 * kReflections> images;
  size_t count = 0;

  LineImages(double x, double lo, double hi, double margin, double reach) {
    const auto add = [&](double sign, double offset) {
      const double gap = outside(sign * x + offset, lo + margin, hi - margin);
      if (gap < reach) images[count++] = {sign, offset, gap};
    };
    add(1, 0);
    const bool both = std::isfinite(lo) && std::isfinite(hi);
    for (int k = 1; k <= (both ? kReflections : 1); ++k)
      for (const double wall : {lo, hi}) {
        if (!std::isfinite(wall)) continue;
        const double across = both ? (wall == lo ? lo - hi : hi - lo) : 0;
        if (k % 2 == 0)
          add(1, k * across);
        else
          add(-1, 2 * wall + (k - 1) * across);
      }
  }
  std::span<const LineImage> all() const { return {images.data(), count}; }
};

}  // namespace

std::vector<Image> imagesNear(const glm::dvec3& x, const Walls& walls, double reach) {
  const glm::dvec3 &lo = walls.lo, &hi = walls.hi;
  std::vector<Image> images;
  const auto along = [&](int axis) { return LineImages(x[axis], lo[axis], hi[axis], walls.margin, reach); };
  const LineImages onX = along(0), onY = along(1), onZ = along(2);
  for (const LineImage& a : onX.all())
    for (const LineImage& b : onY.all())
      for (const LineImage& c : onZ.all()) {
        const Image image{{a.sign, b.sign, c.sign}, {a.offset, b.offset, c.offset}};
        if (image.sign == glm::dvec3(1) && image.offset == glm::dvec3(0)) continue;
        const glm::dvec3 at = image.of(x);
        bool absent = false;
        for (int axis = 0; axis < 3; ++axis)
          absent |= (at[axis] < lo[axis] && walls.isOutflow(axis, false, x)) || (at[axis] > hi[axis] && walls.isOutflow(axis, true, x));
        if (!absent && glm::length(glm::dvec3(a.gap, b.gap, c.gap)) < reach) images.push_back(image);
      }
  return images;
}

}  // namespace rill::reference
