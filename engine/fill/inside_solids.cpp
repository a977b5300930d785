#include "fill/inside_solids.hpp"

#include <algorithm>
#include <limits>

namespace rill {

size_t InsideSolids::cellAlong(size_t axis, double x) const {
  const double width = high_[axis] - low_[axis];
  const double at = width > 0 ? (x - low_[axis]) / width * static_cast<double>(cells_) : 0.0;
  return static_cast<size_t>(std::clamp(at, 0.0, static_cast<double>(cells_ - 1)));
}

InsideSolids::InsideSolids(std::span<const Solid> solids, double spacing) {
  for (size_t axis = 0; axis < 3; ++axis) {
    low_[axis] = std::numeric_limits<double>::infinity();
    high_[axis] = -low_[axis];
  }
  for (const Solid& solid : solids) {
    const Pose pose = solidPose(solid, 0);
    Body& body = bodies_.emplace_back(Body{solid.shape, pose, shellOf(solid.shape, spacing), sceneBox(solid.shape, pose)});
    for (size_t axis = 0; axis < 3; ++axis) {
      body.box.low[axis] -= body.shell;
      body.box.high[axis] += body.shell;
      low_[axis] = std::min(low_[axis], body.box.low[axis]);
      high_[axis] = std::max(high_[axis], body.box.high[axis]);
    }
  }
  cells_ = bodies_.size() > 8 ? 16 : 1;
  inCell_.resize(cells_ * cells_ * cells_);
  for (uint32_t i = 0; i < bodies_.size(); ++i) {
    size_t from[3], to[3];
    for (size_t axis = 0; axis < 3; ++axis) {
      from[axis] = cellAlong(axis, bodies_[i].box.low[axis]);
      to[axis] = cellAlong(axis, bodies_[i].box.high[axis]);
    }
    for (size_t z = from[2]; z <= to[2]; ++z) {
      for (size_t y = from[1]; y <= to[1]; ++y) {
        for (size_t x = from[0]; x <= to[0]; ++x) inCell_[(z * cells_ + y) * cells_ + x].push_back(i);
      }
    }
  }
}

std::optional<size_t> InsideSolids::find(const Double3& p, double margin) const {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(p[axis] > low_[axis] && p[axis] < high_[axis])) return {};
  }
  const auto& near = inCell_[(cellAlong(2, p[2]) * cells_ + cellAlong(1, p[1])) * cells_ + cellAlong(0, p[0])];
  const auto first = std::find_if(near.begin(), near.end(), [&](uint32_t i) {
    const Body& body = bodies_[i];
    for (size_t axis = 0; axis < 3; ++axis)
      if (p[axis] < body.box.low[axis] || p[axis] > body.box.high[axis]) return false;
    return surfaceAt(body.shape, body.pose, p).distance - body.shell < -margin;
  });
  return first == near.end() ? std::nullopt : std::optional<size_t>(*first);
}

}  // namespace rill
