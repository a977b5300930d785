#pragma once
// Tests whether points are inside solids at time 0.
#include <cstdint>
#include <span>
#include <vector>

#include "rill/scene.hpp"

namespace rill {

/// The solids of a scene at t = 0, in a coarse grid so that a query stays cheap with thousands of them.
class SolidTest {
 public:
  explicit SolidTest(std::span<const Solid> solids);

  /// Whether p (m, scene coordinates) is deeper than `margin` (m) inside a solid.
  bool inside(const double (&p)[3], double margin) const;

 private:
  struct Body {
    double center[3];
    double half[3];      ///< half extents of a box, in its own frame
    double axes[3][3];   ///< axes of a box in scene coordinates
    double radius = -1;  ///< radius of a sphere; negative: a box
    double extent[3];    ///< half extents of the axis-aligned bounds
    bool contains(const double (&p)[3], double margin) const;
  };
  static Body bodyOf(const Solid& solid);
  size_t cellAlong(int axis, double x) const;

  std::vector<Body> bodies_;
  size_t cells_ = 1;                                 // along each axis
  double low_[3] = {0, 0, 0}, high_[3] = {0, 0, 0};  // bounds of all bodies
  std::vector<std::vector<uint32_t>> inCell_;
};

}  // namespace rill
