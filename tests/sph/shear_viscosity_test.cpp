#include "sph/shear_viscosity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shared/shear_viscosity.h"
#include "shared/viscosity_steps.h"

namespace rill {
namespace {

TEST(ShearViscosityLaw, IsThatOfHerschelAndBulkley) {
  const Rheology ketchup{18.7, 32, 0.27};
  for (const double rate : {0.1, 1.0, 50.0}) EXPECT_NEAR(viscosityAt(ketchup, rate) * rate, 32 + 18.7 * std::pow(rate, 0.27), 1e-9) << rate;
  EXPECT_EQ(viscosityAt({0.001, 0, 1}, 7), 0.001);
}

TEST(ShearViscosityLaw, IsFiniteAtAnyRate) {
  const Rheology thickening{1, 0, 2};
  EXPECT_EQ(viscosityAt({10, 20, 1}, 0), viscosityAt({10, 20, 1}, kMinShearRate));
  EXPECT_EQ(viscosityAt(thickening, 1e30), viscosityAt(thickening, kMaxShearRate));
  EXPECT_EQ(largestViscosity(thickening), kMaxShearRate);
  EXPECT_EQ(largestViscosity(Rheology{10, 20, 1}), viscosityAt({10, 20, 1}, 0));
  EXPECT_EQ(largestViscosity(Rheology{3, 0, 1}), 3);
}

TEST(ShearViscosityLaw, KnowsNewtonianFluids) {
  EXPECT_FALSE(isShearDependent({1, 0, 1}));
  EXPECT_FALSE(isShearDependent({0, 0, 0.5}));
  EXPECT_TRUE(isShearDependent({1, 0, 0.5}));
  EXPECT_TRUE(isShearDependent({0, 5, 1}));
}

TEST(ShearViscosityLaw, FindsTheBoundThatStepsReach) {
  for (const unsigned steps : {1u, 4u, 64u}) {
    const double bound = reachedBound(steps);
    EXPECT_LE(shared::viscositySteps(0.99 * bound, 100).count, steps) << steps;
    EXPECT_GT(shared::viscositySteps(1.01 * bound, 100).count, steps) << steps;
  }
}

}  // namespace
}  // namespace rill
