#pragma once
// Tests whether points are inside solids at time 0.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shape/pose.hpp"

namespace rill {

/// The solids of a scene at t = 0, in a coarse grid so that a query stays cheap with thousands of them.
class InsideSolids {
 public:
  /// `spacing`: of the fluid, m.
  InsideSolids(std::span<const Solid> solids, double spacing);

  /// Index of the first solid that has p (m, scene coordinates) deeper than `margin` (m) inside.
  std::optional<size_t> find(const Double3& p, double margin) const;
  bool contain(const Double3& p, double margin) const { return find(p, margin).has_value(); }

 private:
  struct Body {
    Shape shape;
    Pose pose;
    double shell;  ///< half the thickness of a sheet, m
    SceneBox box;
  };
  size_t cellAlong(size_t axis, double x) const;

  std::vector<Body> bodies_;
  size_t cells_ = 1;              // along each axis
  Double3 low_ = {}, high_ = {};  // bounds of all bodies
  std::vector<std::vector<uint32_t>> inCell_;
};

}  // namespace rill
