#pragma once
// Whether a point is inside a solid at the start.
#include <cstdint>
#include <span>
#include <vector>

#include "rill/scene.hpp"

namespace rill {

/// The scene's solids where they are at t = 0, in coarse cells so that thousands of them cost a point little.
class SolidTest {
 public:
  explicit SolidTest(std::span<const Solid> solids);

  /// True where p (m, in the scene's coordinates) is deeper than `margin` (m) inside one of the solids.
  bool inside(const double (&p)[3], double margin) const;

 private:
  struct Body {
    double center[3];
    double half[3];      ///< of a box, before it is turned
    double axes[3][3];   ///< a box's own axes in the scene's coordinates
    double radius = -1;  ///< of a sphere; negative: a box
    double extent[3];    ///< half the size of what encloses it along the scene's axes
    bool holds(const double (&p)[3], double margin) const;
  };
  static Body bodyOf(const Solid& solid);
  size_t cellAlong(int axis, double x) const;

  std::vector<Body> bodies_;
  size_t cells_ = 1;                                 // along each axis
  double low_[3] = {0, 0, 0}, high_[3] = {0, 0, 0};  // around all bodies
  std::vector<std::vector<uint32_t>> inCell_;
};

}  // namespace rill
