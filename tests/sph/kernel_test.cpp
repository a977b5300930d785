#include "sph/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

namespace {

using rill::KernelChoice;
using rill::SmoothingKernel;

constexpr double kSpacing = 0.05;

class KernelTest : public testing::TestWithParam<std::tuple<KernelChoice, double>> {
 protected:
  SmoothingKernel kernel() const { return SmoothingKernel(std::get<0>(GetParam()), std::get<1>(GetParam()) * kSpacing, kSpacing); }
};

TEST_P(KernelTest, RestLatticeHasRestDensity) {
  const SmoothingKernel k = kernel();
  double sum = 0, moment = 0, gradients = 0;
  for (int i = -5; i <= 5; ++i)
    for (int j = -5; j <= 5; ++j)
      for (int l = -5; l <= 5; ++l) {
        const double r = kSpacing * std::sqrt(double(i * i + j * j + l * l));
        sum += k.value(r);
        moment += k.value(r) * (kSpacing * l) * (kSpacing * l);
        gradients += std::pow(k.gradientOverR(r) * r, 2);
      }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(moment / k.secondMoment(), 1, 1e-12);
  EXPECT_NEAR(gradients / k.restGradientSum(), 1, 1e-12);
}

TEST(GradientOfUnitTest, NearsOneWithSupport) {
  const SmoothingKernel narrow(KernelChoice::Wendland, 2 * kSpacing, kSpacing), wide(KernelChoice::Wendland, 8 * kSpacing, kSpacing);
  EXPECT_NEAR(narrow.gradientOfUnit(), 0.9501, 1e-4);
  EXPECT_NEAR(wide.gradientOfUnit(), 1, 1e-4);
}

// The integral of K over space is d^3 up to the discretization error of the lattice, which vanishes as h/d grows.
TEST_P(KernelTest, IntegratesToParticleVolume) {
  const SmoothingKernel k = kernel();
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double r = (i + 0.5) / n * k.h();
    sum += k.value(r) * 4 * std::numbers::pi * r * r * k.h() / n;
  }
  const double ratio = std::get<1>(GetParam());
  EXPECT_NEAR(sum / std::pow(kSpacing, 3), 1, ratio >= 3 ? 0.01 : ratio >= 2 ? 0.1 : 0.6);
}

TEST_P(KernelTest, FallsToZeroAtTheSupport) {
  const SmoothingKernel k = kernel();
  for (int i = 0; i < 100; ++i) {
    EXPECT_GT(k.value(k.h() * i / 100), k.value(k.h() * (i + 1) / 100));
    EXPECT_LE(k.gradientOverR(k.h() * i / 100), 0);
  }
  EXPECT_EQ(k.value(k.h()), 0);
  EXPECT_EQ(k.value(2 * k.h()), 0);
  EXPECT_EQ(k.gradientOverR(k.h()), 0);
  EXPECT_EQ(k.gradientOverR(2 * k.h()), 0);
}

TEST_P(KernelTest, ScalesReproduceKernel) {
  const SmoothingKernel k = kernel();
  for (int i = 1; i < 20; ++i) {
    const double q = i / 20.0, r = q * k.h(), t = 1 - q;
    if (k.choice() == KernelChoice::Wendland) {
      EXPECT_NEAR(k.valueScale() * std::pow(t, 4) * (1 + 4 * q), k.value(r), 1e-15);
      EXPECT_NEAR(k.gradientScale() * std::pow(t, 3) / k.gradientOverR(r), 1, 1e-12);
    } else {
      EXPECT_NEAR(k.valueScale() * std::pow(1 - q * q, 3), k.value(r), 1e-15);
      EXPECT_NEAR(k.gradientScale() * t * t / r / k.gradientOverR(r), 1, 1e-12);
    }
  }
}

TEST_P(KernelTest, IsScaleInvariant) {
  const SmoothingKernel k = kernel();
  const SmoothingKernel large(k.choice(), 100 * k.h(), 100 * kSpacing);
  EXPECT_NEAR(large.value(0.3 * large.h()), k.value(0.3 * k.h()), 1e-14);
  EXPECT_NEAR(large.restGradientSum() * 1e4 / k.restGradientSum(), 1, 1e-12);
  EXPECT_NEAR(large.secondMoment() * 1e-4 / k.secondMoment(), 1, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, KernelTest,
                         testing::Combine(testing::Values(KernelChoice::Wendland, KernelChoice::Poly6Spiky),
                                          testing::Values(1.2, 1.5, 2.0, 2.5, 3.0, 4.0)));

TEST(WendlandKernel, GradientIsTheDerivativeOfTheValue) {
  for (const double ratio : {1.2, 2.0, 4.0}) {
    const SmoothingKernel k(KernelChoice::Wendland, ratio * kSpacing, kSpacing);
    const double step = 1e-5 * k.h();
    for (int i = 1; i < 40; ++i) {
      const double r = k.h() * i / 40;
      const double slope = (k.value(r + step) - k.value(r - step)) / (2 * step);
      EXPECT_NEAR(k.gradientOverR(r) * r, slope, 1e-7 * std::abs(k.gradientScale()) * k.h());
    }
  }
}

TEST(SpikyGradient, IsTheDerivativeOfItsOwnNormalizedKernel) {
  const double h = 2 * kSpacing;
  const SmoothingKernel k(KernelChoice::Poly6Spiky, h, kSpacing);
  const auto spiky = [&](double r) { return std::pow(kSpacing, 3) * 15 / (std::numbers::pi * std::pow(h, 6)) * std::pow(h - r, 3); };
  for (int i = 1; i < 40; ++i) {
    const double r = h * i / 40, step = 1e-5 * h;
    EXPECT_NEAR(k.gradientOverR(r) * r, (spiky(r + step) - spiky(r - step)) / (2 * step), 1e-6);
  }
  EXPECT_EQ(k.gradientOverR(0), 0);
}

}  // namespace
