#include "sph/artificial_pressure.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rill {
namespace {

constexpr KernelChoice kKernels[] = {KernelChoice::Wendland, KernelChoice::Poly6Spiky};

TEST(ArtificialPressure, IsInvariantUnderKernelAndScale) {
  for (const KernelChoice choice : kKernels)
    for (const double ratio : {1.2, 1.5, 2.0, 2.3, 3.0})
      for (const double d : {0.001, 0.05, 3.0}) {
        const SmoothingKernel kernel(choice, ratio * d, d);
        const ArtificialPressure pressure(kernel, 1, 0.1, 16);
        double acceleration = 0, displacement = 0;
        for (double r = 0.001 * d; r < d; r += 0.001 * d) {
          const double step = -kernel.gradientOverR(r) * r / kernel.restGradientSum();
          acceleration = std::max(acceleration, pressure.rate * step);
          displacement = std::max(displacement, pressure.most * step);
        }
        EXPECT_NEAR(acceleration, 28.7 * 9.81, 3) << ratio << " " << d;
        EXPECT_NEAR(displacement, 0.05 * d, 0.0005 * d) << ratio << " " << d;
      }
}

TEST(ArtificialPressure, ActsOnClosePairsButNotOnRestLattice) {
  const double d = 0.1;
  for (const KernelChoice choice : kKernels)
    for (const double ratio : {1.2, 2.0, 4.0})
      for (const double reach : {0.01, 0.2, 0.5, 0.9, 0.94, 0.96, 1.1})  // spacings
        for (const double power : {1.0, 4.0, 16.0}) {
          const SmoothingKernel kernel(choice, ratio * d, d);
          const ArtificialPressure pressure(kernel, 1, reach / ratio, power);
          EXPECT_EQ(pressure.factor(kernel.value(d)), 0) << ratio << " " << reach << " " << power;
          EXPECT_EQ(pressure.rate > 0, reach < 0.95) << ratio << " " << reach << " " << power;
          EXPECT_EQ(pressure.factor(kernel.value(0)) > 0, reach < 0.95) << ratio << " " << reach << " " << power;
        }
}

}  // namespace
}  // namespace rill
