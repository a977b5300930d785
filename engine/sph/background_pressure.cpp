#include "sph/background_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/background_pressure.h"

namespace rill {
namespace {

/// 0 up to `from`, 1 from `until` on.
double smoothstep(double from, double until, double x) {
  const double t = std::clamp((x - from) / (until - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

double backgroundShare(double speed, double coherence, double gravity, double spacing, double support) {
  if (gravity == 0) return 0;
  const double slow = double{kBackgroundSpeed} * kBackgroundSpeed * gravity * spacing;
  const double enough = std::clamp((support / spacing - kTooFewNeighbors) / (kEnoughNeighbors - kTooFewNeighbors), 0.0, 1.0);
  return kBackgroundShare * enough * std::max(speed * speed / (speed * speed + slow), coherence);
}

double coherence(double mean, double difference, double layerSpeed, double layers) {
  const double noise = std::pow(kCoherentSpeed * layerSpeed, 2) + std::pow(kCoherentNoise * difference, 2);
  return mean > 0 ? smoothstep(kShallow, kDeep, layers) * mean * mean / (mean * mean + noise) : 0;
}

double backgroundFactor(double unevenness) { return 1 - smoothstep(kEvenSupport, kUnevenSupport, unevenness); }

glm::dvec3 alongSurface(const glm::dvec3& gradient, const glm::dvec3& displaced, double spacing) {
  const double least = double{kMinDisplaced} / spacing;
  return gradient - glm::dot(gradient, displaced) / (glm::dot(displaced, displaced) + least * least) * displaced;
}

}  // namespace rill
