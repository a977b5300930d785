#pragma once
// Images of particles behind the domain's walls, which are mirrors.
#include <glm/vec3.hpp>
#include <vector>

namespace rill::reference {

/// An isometry x -> sign x + offset, component by component.
struct Image {
  glm::dvec3 sign = {1, 1, 1};
  glm::dvec3 offset = {0, 0, 0};
  glm::dvec3 of(const glm::dvec3& x) const { return sign * x + offset; }
};

/// Walls at `lo` and `hi` (m; infinite: open), which centers are kept `margin` (m) inside of.
struct Walls {
  glm::dvec3 lo, hi;
  double margin = 0;
  // An outflow: the wall of this axis is one up to a level (m, along y) only.
  int outflowAxis = -1;
  bool outflowHigh = false;
  double outflowLevel = 0;
  bool isOutflow(int axis, bool high, const glm::dvec3& x) const {
    return axis == outflowAxis && high == outflowHigh && x.y > outflowLevel;
  }
};

/// The images that can have a particle inside the walls within `reach` (m) of the image of `x`. Walls that face each other
/// reflect images, too. The identity is not among them.
std::vector<Image> imagesNear(const glm::dvec3& x, const Walls& walls, double reach);

}  // namespace rill::reference
