#include "sph/background_pressure.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "shared/background_pressure.h"

namespace rill {

double backgroundShare(double speed, double gravity, double spacing, double support) {
  if (gravity == 0) return 0;
  const double slow = double{kBackgroundSpeed} * kBackgroundSpeed * gravity * spacing;
  const double enough = std::clamp((support / spacing - kTooFewNeighbors) / (kEnoughNeighbors - kTooFewNeighbors), 0.0, 1.0);
  return kBackgroundShare * enough * speed * speed / (speed * speed + slow);
}

double backgroundFactor(double unevenness) {
  const double t = std::clamp((unevenness - kEvenSupport) / (kUnevenSupport - kEvenSupport), 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

glm::dvec3 alongSurface(const glm::dvec3& gradient, const glm::dvec3& displaced, double spacing) {
  const double least = double{kMinDisplaced} / spacing;
  return gradient - glm::dot(gradient, displaced) / (glm::dot(displaced, displaced) + least * least) * displaced;
}

}  // namespace rill
