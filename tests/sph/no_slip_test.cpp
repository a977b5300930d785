#include "sph/no_slip.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sph/viscosity.hpp"

namespace rill {
namespace {

// On the rest lattice a linear profile beside a plane gets nothing: what the fluid's neighbors add, the plane takes.
TEST(NoSlip, KeepsALinearProfileBesideAPlane) {
  constexpr double kD = 0.1;
  for (const double ratio : {1.5, 2.0, 2.3, 3.0}) {
    const SmoothingKernel kernel(KernelChoice::Wendland, ratio * kD, kD);
    const HalfSpaceTable plane = makeHalfSpaceTable(kernel);
    const std::vector<float> table = makeNoSlipTable(kernel);
    for (int layer = 0; layer < 4; ++layer) {
      const double y = (layer + 0.5) * kD;
      double fluid = 0;
      for (int i = -4; i <= 4; ++i)
        for (int j = -layer; j <= 4; ++j)
          for (int k = -4; k <= 4; ++k) fluid += pairWeight(std::sqrt(i * i + j * j + k * k) / ratio) * i * i / (ratio * ratio) * j * kD;
      const double wall = -plane.sample(y).slope * sampleNoSlip(table, plane.step, y) * y;
      EXPECT_NEAR(fluid, wall, 1e-6 * kD) << ratio << " " << layer;
    }
  }
}

// The force of all layers is that of the fluid's own shear: half of the sum of w q_x^2 y^2.
TEST(NoSlip, GivesThePlaneTheShearStress) {
  constexpr double kD = 0.1, kRatio = 2.3;
  const SmoothingKernel kernel(KernelChoice::Wendland, kRatio * kD, kD);
  double sum = 0, fluid = 0;
  for (int layer = 0; layer < 4; ++layer) {
    const double y = (layer + 0.5) * kD;
    sum += -halfSpace(kernel, y).slope * noSlipLength(kernel, y) * y * kD;
  }
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      for (int k = -3; k <= 3; ++k)
        fluid += pairWeight(std::sqrt(i * i + j * j + k * k) / kRatio) * i * i / (kRatio * kRatio) * j * j * kD * kD / 2;
  EXPECT_NEAR(sum, fluid, 1e-9);
  EXPECT_EQ(sampleNoSlip(makeNoSlipTable(kernel), kD / 16, 3 * kD), 0);
}

}  // namespace
}  // namespace rill
