#include "sph/liquid_scale.hpp"

#include <gtest/gtest.h>

namespace rill::test {
namespace {

double scaleAt(double ratio, KernelChoice choice = KernelChoice::Wendland) { return liquidScale(SmoothingKernel(choice, ratio, 1)); }

// Sums from an independent program (docs/notes/rest-state.md).
TEST(LiquidScale, FollowsTheLeastLatticeSum) {
  EXPECT_EQ(scaleAt(2), 1) << "the cubic lattice is the least";
  EXPECT_NEAR(scaleAt(2.3), 1 / (1 - 0.0042), 1e-4) << "face-centered";
  EXPECT_NEAR(scaleAt(2.5), 1 / (1 - 0.0056), 1e-4) << "body-centered";
}

TEST(LiquidScale, DoesNotDependOnTheSpacing) {
  EXPECT_NEAR(liquidScale(SmoothingKernel(KernelChoice::Wendland, 0.046, 0.02)), scaleAt(2.3), 1e-12);
}

TEST(LiquidScale, IsOneForShortSupportsAndOtherKernels) {
  for (const double ratio : {1.2, 1.5, 1.8, 2.3, 2.8, 3.3, 4.0}) {
    if (ratio < 2) { EXPECT_EQ(scaleAt(ratio), 1) << ratio; }
    EXPECT_GE(scaleAt(ratio), 1) << ratio;
    EXPECT_LE(scaleAt(ratio), 1.006) << ratio;
    EXPECT_EQ(scaleAt(ratio, KernelChoice::Poly6Spiky), 1) << ratio;
  }
}

}  // namespace
}  // namespace rill::test
