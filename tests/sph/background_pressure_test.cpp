#include "sph/background_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/background_pressure.h"

namespace rill {
namespace {

TEST(BackgroundPressure, IsLeftOutInMotionUnderGravityOnly) {
  EXPECT_EQ(backgroundShare(3, 0, 0, 0.1, 0.23), 0);
  EXPECT_EQ(backgroundShare(0, 0, 9.81, 0.1, 0.23), 0);
  EXPECT_NEAR(backgroundShare(100, 0, 9.81, 0.1, 0.23), kBackgroundShare, 1e-3);
  double last = 0;
  for (double speed = 0.01; speed < 3; speed *= 2) {
    EXPECT_GT(backgroundShare(speed, 0, 9.81, 0.1, 0.23), last);
    last = backgroundShare(speed, 0, 9.81, 0.1, 0.23);
  }
  EXPECT_NEAR(backgroundShare(kBackgroundSpeed * std::sqrt(9.81 * 0.1), 0, 9.81, 0.1, 0.23), kBackgroundShare / 2, 1e-6);
}

// A scene and the same one at another size, at the times that gravity gives it.
TEST(BackgroundPressure, IsThatOfSimilarFlows) {
  EXPECT_NEAR(backgroundShare(0.4, 0, 9.81, 0.2, 0.46), backgroundShare(0.2, 0, 9.81, 0.05, 0.115), 1e-12);
  EXPECT_NEAR(backgroundShare(0.4, 0, 9.81, 0.1, 0.23), backgroundShare(0.2, 0, 9.81 / 4, 0.1, 0.23), 1e-12);
}

TEST(BackgroundPressure, IsWholeWithFewNeighbors) {
  EXPECT_EQ(backgroundShare(100, 0, 9.81, 0.1, 0.12), 0);
  EXPECT_NEAR(backgroundShare(100, 0, 9.81, 0.1, 0.175), kBackgroundShare / 2, 1e-3);
  EXPECT_EQ(backgroundShare(100, 0, 9.81, 0.1, 0.2), backgroundShare(100, 0, 9.81, 0.1, 0.3));
}

// Slow flow feels as little of it as fast flow; noise, whose mean over neighbors is small, and fluid at rest do not.
TEST(BackgroundPressure, IsLeftOutInSlowFlow) {
  constexpr double kLayerSpeed = 2;
  EXPECT_EQ(coherence(0, 0, kLayerSpeed, kDeep), 0);
  EXPECT_EQ(coherence(0, 1, kLayerSpeed, kDeep), 0);
  EXPECT_EQ(coherence(0, 0, 0, kDeep), 0);
  EXPECT_NEAR(coherence(kCoherentSpeed * kLayerSpeed, 0, kLayerSpeed, kDeep), 0.5, 1e-12);
  EXPECT_NEAR(coherence(1e6, 1e6 / kCoherentNoise, kLayerSpeed, kDeep), 0.5, 1e-9);
  EXPECT_NEAR(coherence(1e6, 1e6, kLayerSpeed, kDeep), 1 / (1 + std::pow(kCoherentNoise, 2)), 1e-9);
  EXPECT_EQ(coherence(1, 0, kLayerSpeed, kShallow), 0);
  EXPECT_NEAR(coherence(1e6, 0, kLayerSpeed, (kShallow + kDeep) / 2), 0.5, 1e-9);
  EXPECT_NEAR(backgroundShare(1e-3, 0.9, 9.81, 0.1, 0.23), 0.9 * kBackgroundShare, 1e-6);
  EXPECT_EQ(backgroundShare(3, 0.5, 9.81, 0.1, 0.23), backgroundShare(3, 0, 9.81, 0.1, 0.23)) << "of what is fast by itself";
  EXPECT_EQ(backgroundShare(3, 1, 0, 0.1, 0.23), 0) << "no gravity";
}

TEST(BackgroundPressure, IsWholeWhereNeighborsAreUneven) {
  EXPECT_EQ(backgroundFactor(0), 1);
  EXPECT_NEAR(backgroundFactor(kEvenSupport), 1, 1e-9);
  EXPECT_NEAR(backgroundFactor(0.5 * (kEvenSupport + kUnevenSupport)), 0.5, 1e-6);
  EXPECT_NEAR(backgroundFactor(kUnevenSupport), 0, 1e-9);
  EXPECT_EQ(backgroundFactor(1e30), 0);
}

// A solid takes what is across its surface, and nothing else.
TEST(BackgroundPressure, CountsAlongSolidsOnly) {
  constexpr double kSpacing = 0.1;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 2, -2)), along = {0, 3, 3};
  const auto rest = [&](double displaced) {  // over the spacing
    return alongSurface(along + 5.0 * normal, displaced / kSpacing * normal, kSpacing) - along;
  };
  EXPECT_LT(glm::length(rest(0.3)), 1e-4);
  EXPECT_LT(glm::length(rest(-0.3)), 1e-4);
  EXPECT_LT(glm::length(rest(kMinDisplaced) - 2.5 * normal), 1e-9);
  EXPECT_EQ(rest(0), (along + 5.0 * normal) - along);
}

}  // namespace
}  // namespace rill
