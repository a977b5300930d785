#pragma once
// A compressed cloud in free space, on which single stages act.
#include "reference/cloud.hpp"

namespace rill::reference {

inline constexpr double kStageSpacing = 0.05, kStageStep = 1e-3;

inline ReferenceSettings freeSpace() {
  ReferenceSettings s;
  s.spacing = kStageSpacing;
  s.gravity = glm::dvec3(0);
  return s;
}

/// A cloud at about twice the rest density, with a coincident pair.
inline ReferenceSolver crowded(const ReferenceSettings& settings, unsigned seed = 5) {
  std::vector<glm::dvec3> x = randomCloud(300, 5.3 * kStageSpacing, seed);
  x[17] = x[200];
  std::vector<glm::dvec3> v = randomCloud(300, 2, seed + 1, glm::dvec3(-1));
  return ReferenceSolver(settings, x, v);
}

}  // namespace rill::reference
