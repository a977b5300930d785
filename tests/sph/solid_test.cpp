#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "shared/pair_hash.h"
#include "sph/solid_density.hpp"

namespace {

using namespace rill;

constexpr double kSolidSpacing = 0.02;

class SolidTest : public testing::TestWithParam<std::tuple<KernelChoice, double>> {
 protected:
  SmoothingKernel kernel() const {
    return SmoothingKernel(std::get<0>(GetParam()), std::get<1>(GetParam()) * kSolidSpacing, kSolidSpacing);
  }
};

TEST_P(SolidTest, LargeSphereMatchesWall) {
  const SmoothingKernel k = kernel();
  for (int i = 0; i <= 20; ++i) {
    const double s = kSolidSpacing / 2 + (solidReach(k) - kSolidSpacing / 2) * i / 20;
    const LineSample plane = exactPlane(k, s), ball = exactSphere(k, 1e5 * kSolidSpacing, s);
    EXPECT_NEAR(ball.value, plane.value, 1e-4);
    EXPECT_NEAR(ball.slope * kSolidSpacing, plane.slope * kSolidSpacing, 1e-4);
  }
}

TEST_P(SolidTest, SmallerSpheresDisplaceLess) {
  const SmoothingKernel k = kernel();
  const double s = kSolidSpacing / 2;
  double last = exactPlane(k, s).value;
  for (const double R : {100.0, 10.0, 3.0, 1.0, 0.5, 0.1, 0.01}) {
    const LineSample ball = exactSphere(k, R * kSolidSpacing, s);
    EXPECT_LT(ball.value, last);
    EXPECT_GT(ball.value, 0);
    EXPECT_LT(ball.slope, 0);
    last = ball.value;
  }
  EXPECT_LT(last, 1e-4);
}

TEST_P(SolidTest, SphereTableMatchesFormula) {
  const SmoothingKernel k = kernel();
  const double bound = std::get<1>(GetParam()) < 2 ? 5e-3 : 1e-3;
  for (const double R : {0.2, 0.7, 2.0, 5.5, 40.0}) {
    const SphereTable table = makeSphereTable(k, R * kSolidSpacing);
    for (int i = 0; i <= 200; ++i) {
      const double s = table.first + (1.1 * solidReach(k) - table.first) * i / 200;
      const LineSample exact = exactSphere(k, R * kSolidSpacing, s), linear = table.sample(s);
      EXPECT_NEAR(exact.value, linear.value, bound) << "R/d " << R << " s/d " << s / kSolidSpacing;
      if (s > table.first + kSolidSpacing / 8) {
        EXPECT_NEAR(exact.slope * kSolidSpacing, linear.slope * kSolidSpacing, 5 * bound) << "R/d " << R << " s/d " << s / kSolidSpacing;
      }
    }
    EXPECT_EQ(table.sample(1.2 * k.h()).value, 0);
    EXPECT_EQ(table.sample(-1e6).value, table.sample(table.first).value);
  }
}

TEST_P(SolidTest, ThickBoxMatchesWallAndThinPlateDisplacesLess) {
  const SmoothingKernel k = kernel();
  const HalfSpaceTable table = makeHalfSpaceTable(k);
  const double wide = 10 * k.h();
  for (int i = 0; i <= 20; ++i) {
    const double s = kSolidSpacing / 2 + (solidReach(k) - kSolidSpacing / 2) * i / 20;
    const LineSample plane = exactPlane(k, s);
    double last = plane.value;
    for (const double thickness : {2 * k.h(), 1.5 * kSolidSpacing, kSolidSpacing, 0.3 * kSolidSpacing}) {
      const Double3 half = {wide, wide, thickness / 2}, at = {0.1 * kSolidSpacing, -0.2 * kSolidSpacing, -(s + thickness / 2)};
      const SolidSample box = boxSample(k, at, half);
      if (thickness > k.h()) {
        EXPECT_NEAR(box.value, plane.value, 1e-12);
        EXPECT_NEAR(box.gradient[2], -plane.slope, 1e-9 / kSolidSpacing);
        EXPECT_NEAR(boxSample(table, at, half).value, table.sample(s).value, 1e-6);
      }
      EXPECT_LE(box.value, last + 1e-12);
      EXPECT_GE(box.value, 0);
      EXPECT_EQ(box.gradient[0], 0);
      last = box.value;
    }
  }
}

// A plate as thick as one lattice layer contributes the same density as that layer.
TEST_P(SolidTest, PlateOfOneSpacingMatchesOneLayer) {
  const SmoothingKernel k = kernel();
  const Double3 half = {10 * k.h(), 10 * k.h(), kSolidSpacing / 2}, at = {0, 0, kSolidSpacing};
  double layer = 0;
  for (int i = -5; i <= 5; ++i)
    for (int j = -5; j <= 5; ++j) layer += k.value(kSolidSpacing * std::sqrt(i * i + j * j + 1.0));
  EXPECT_NEAR(boxSample(k, at, half).value, layer, 1e-12);
}

TEST(WendlandBox, GradientIsTheDerivativeOfTheValue) {
  const SmoothingKernel k(KernelChoice::Wendland, 2 * kSolidSpacing, kSolidSpacing);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4 * kSolidSpacing, 4 * kSolidSpacing), size(0.2 * kSolidSpacing, 2 * kSolidSpacing);
  for (int sample = 0; sample < 300; ++sample) {
    const Double3 at = {place(random), place(random), place(random)}, half = {size(random), size(random), size(random)};
    const SolidSample box = boxSample(k, at, half);
    for (size_t a = 0; a < 3; ++a) {
      const double step = 1e-6 * kSolidSpacing;
      Double3 low = at, high = at;
      low[a] -= step, high[a] += step;
      const double slope = (boxSample(k, high, half).value - boxSample(k, low, half).value) / (2 * step);
      EXPECT_NEAR(box.gradient[a] * kSolidSpacing, slope * kSolidSpacing, 1e-4);
    }
  }
}

TEST(PairHash, IsAntisymmetricNonZeroAndUniform) {
  Double3 mean = {0, 0, 0};
  int count = 0;
  for (uint32_t i = 0; i < 60; ++i) {
    for (uint32_t j = 0; j < i; ++j, ++count) {
      for (uint32_t a = 0; a < 3; ++a) {
        const int32_t component = shared::pairDirection(i, j, a);
        EXPECT_EQ(component, -shared::pairDirection(j, i, a));
        EXPECT_NE(component, 0);
        EXPECT_LE(std::abs(component), 1023);
        mean[a] += component / 1023.0;
      }
    }
  }
  for (const double m : mean) EXPECT_LT(std::abs(m / count), 0.06);
}

INSTANTIATE_TEST_SUITE_P(All, SolidTest,
                         testing::Combine(testing::Values(KernelChoice::Wendland, KernelChoice::Poly6Spiky),
                                          testing::Values(1.2, 2.0, 3.0, 4.0)));

}  // namespace
