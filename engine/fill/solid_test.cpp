#include "fill/solid_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rill {

SolidTest::Body SolidTest::bodyOf(const Solid& solid) {
  Body body{};
  const double* moved =
      solid.motion.empty() ? nullptr : solid.motion.front().translate;  // constant before the first keyframe, whose time is >= 0
  body.radius = solid.sphere ? solid.sphere->radius : -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (solid.sphere) {
      body.center[axis] = solid.sphere->center[axis];
      body.extent[axis] = body.radius;
    } else if (solid.box) {
      body.center[axis] = 0.5 * (solid.box->min[axis] + solid.box->max[axis]);
      body.half[axis] = 0.5 * (solid.box->max[axis] - solid.box->min[axis]);
    }
    if (moved != nullptr) body.center[axis] += moved[axis];
  }
  if (solid.sphere) return body;
  const double x = solid.rotation[0], y = solid.rotation[1], z = solid.rotation[2], w = solid.rotation[3];
  const double axes[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                             {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                             {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
  for (int own = 0; own < 3; ++own) {
    for (int axis = 0; axis < 3; ++axis) {
      body.axes[own][axis] = axes[own][axis];
      body.extent[axis] += std::abs(axes[own][axis]) * body.half[own];
    }
  }
  return body;
}

bool SolidTest::Body::contains(const double (&p)[3], double margin) const {
  const double d[3] = {p[0] - center[0], p[1] - center[1], p[2] - center[2]};
  if (radius >= 0) return radius > margin && d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < (radius - margin) * (radius - margin);
  for (int own = 0; own < 3; ++own) {
    if (std::abs(d[0] * axes[own][0] + d[1] * axes[own][1] + d[2] * axes[own][2]) >= half[own] - margin) return false;
  }
  return true;
}

size_t SolidTest::cellAlong(int axis, double x) const {
  const double width = high_[axis] - low_[axis];
  const double at = width > 0 ? (x - low_[axis]) / width * static_cast<double>(cells_) : 0.0;
  return static_cast<size_t>(std::clamp(at, 0.0, static_cast<double>(cells_ - 1)));
}

SolidTest::SolidTest(std::span<const Solid> solids) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::fill(low_, low_ + 3, kInfinity);
  std::fill(high_, high_ + 3, -kInfinity);
  for (const Solid& solid : solids) {
    const Body& body = bodies_.emplace_back(bodyOf(solid));
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], body.center[axis] - body.extent[axis]);
      high_[axis] = std::max(high_[axis], body.center[axis] + body.extent[axis]);
    }
  }
  cells_ = bodies_.size() > 8 ? 16 : 1;
  inCell_.resize(cells_ * cells_ * cells_);
  for (uint32_t i = 0; i < bodies_.size(); ++i) {
    size_t from[3], to[3];
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = cellAlong(axis, bodies_[i].center[axis] - bodies_[i].extent[axis]);
      to[axis] = cellAlong(axis, bodies_[i].center[axis] + bodies_[i].extent[axis]);
    }
    for (size_t z = from[2]; z <= to[2]; ++z) {
      for (size_t y = from[1]; y <= to[1]; ++y) {
        for (size_t x = from[0]; x <= to[0]; ++x) inCell_[(z * cells_ + y) * cells_ + x].push_back(i);
      }
    }
  }
}

bool SolidTest::inside(const double (&p)[3], double margin) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(p[axis] > low_[axis] && p[axis] < high_[axis])) return false;
  }
  const auto& near = inCell_[(cellAlong(2, p[2]) * cells_ + cellAlong(1, p[1])) * cells_ + cellAlong(0, p[0])];
  return std::any_of(near.begin(), near.end(), [&](uint32_t i) { return bodies_[i].contains(p, margin); });
}

}  // namespace rill
