// What particles feel of a pressure that is the same all around: nothing, if their neighbors were spread evenly.
#include <gtest/gtest.h>

#include "reference/crowded.hpp"

namespace rill::reference {
namespace {

/// Speeds (m/s, root mean square) that a substep gives to the inner particles of a compressed, slightly disordered block, which moves.
double noiseUnderPressure(double gravity, double jitter) {
  ReferenceSettings s = freeSpace();
  s.gravity = {0, -gravity, 0};
  constexpr int kCount = 13;
  constexpr double kCompressed = 0.9;
  std::vector<glm::dvec3> x = lattice(kCount, kCount, kCount, kCompressed * kStageSpacing);
  const std::vector<glm::dvec3> by = randomCloud(x.size(), 2 * jitter * kStageSpacing, 3, glm::dvec3(-jitter * kStageSpacing));
  for (size_t i = 0; i < x.size(); ++i) x[i] += by[i];
  const glm::dvec3 flow(1, 0, 0);
  ReferenceSolver solver(s, x, std::vector<glm::dvec3>(x.size(), flow));
  solver.begin(kStageStep);
  solver.substep(kStageStep, kStageStep);
  double sum = 0, count = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const glm::dvec3 from = glm::abs(x[i] / (kCompressed * kStageSpacing) - 0.5 * kCount);
    if (std::max({from.x, from.y, from.z}) > 0.5 * kCount - 4) continue;
    const glm::dvec3 given = solver.state.velocity[i] - flow;
    sum += glm::dot(given, given);
    ++count;
  }
  return std::sqrt(sum / count);
}

// Gravity too small to move anything turns the share on.
TEST(BackgroundPressure, GivesLessNoiseToFlows) {
  const double whole = noiseUnderPressure(0, 0.01), part = noiseUnderPressure(1e-9, 0.01);
  EXPECT_GT(whole, 0.01);
  EXPECT_LT(part, 0.4 * whole);
}

// Unevenness beyond what the share is for, as at a surface or where neighbors clump.
TEST(BackgroundPressure, ActsInFullOnUnevenNeighbors) {
  const double whole = noiseUnderPressure(0, 0.2), part = noiseUnderPressure(1e-9, 0.2);
  EXPECT_GT(part, 0.9 * whole);
}

}  // namespace
}  // namespace rill::reference
