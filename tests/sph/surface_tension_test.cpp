#include "sph/surface_tension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/vector_math.hpp"

namespace rill::test {
namespace {

TEST(TensionSamples, DirectionsAreTheCornersOfADodecahedron) {
  const auto directions = tensionDirections();
  for (size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(length(directions[i]), 1, 1e-7);
    int opposite = 0, nearest = 0;
    for (size_t j = 0; j < directions.size(); ++j) {
      const double cosine = dot(directions[i], directions[j]);
      opposite += std::abs(cosine + 1) < 1e-6;
      nearest += std::abs(cosine - std::sqrt(5.0) / 3) < 1e-6;
    }
    EXPECT_EQ(opposite, 1) << i;
    EXPECT_EQ(nearest, 3) << i;
  }
}

TEST(TensionSamples, WeightGoesFromWetToFree) {
  for (const double cosine : {-1.0, -0.3, 0.0, 0.5, 1.0}) {
    EXPECT_EQ(tensionWeight(-0.5, cosine).value, -cosine);
    EXPECT_EQ(tensionWeight(0, cosine).value, -cosine);
    EXPECT_NEAR(tensionWeight(1, cosine).value, 1, 1e-12);
    EXPECT_NEAR(tensionWeight(7, cosine).value, 1, 1e-12);
    EXPECT_EQ(tensionWeight(7, cosine).slope, 0);
    constexpr double kSmall = 1e-6;
    for (const double y : {0.2, 0.5, 0.9}) {
      const double slope = (tensionWeight(y + kSmall, cosine).value - tensionWeight(y - kSmall, cosine).value) / (2 * kSmall);
      EXPECT_NEAR(tensionWeight(y, cosine).slope, slope, 1e-8);
    }
  }
}

TEST(TensionSamples, StepFollowsCapillaryWaves) {
  EXPECT_EQ(capillaryStep(0, 1000, 0.01), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(capillaryStep(0.072, 1000, 0.001), 0.745e-3, 1e-5);
  EXPECT_NEAR(capillaryStep(0.072, 1000, 0.004) / capillaryStep(0.072, 1000, 0.001), 8, 1e-9);
}

}  // namespace
}  // namespace rill::test
