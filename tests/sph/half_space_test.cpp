// A half-space beside a rest lattice, and what solids do to corrections along them.
#include "sph/half_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "sph/solid_scale.hpp"

namespace {

using rill::Double3;
using rill::HalfSpaceTable;
using rill::KernelChoice;
using rill::LineSample;
using rill::SmoothingKernel;
using rill::SolidSample;

constexpr double kHalfSpacing = 0.02, kFar = std::numeric_limits<double>::infinity();

class HalfSpaceTest : public testing::TestWithParam<std::tuple<KernelChoice, double>> {
 protected:
  SmoothingKernel kernel() const { return SmoothingKernel(std::get<0>(GetParam()), std::get<1>(GetParam()) * kHalfSpacing, kHalfSpacing); }
  double ratio() const { return std::get<1>(GetParam()); }
};

/// Of the layers of a lattice from `first` on, seen from a particle of layer 0, and their pull.
LineSample layersFrom(const SmoothingKernel& k, int first) {
  const int reach = static_cast<int>(std::ceil(k.h() / k.spacing()));
  LineSample sum;
  for (int x = first; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        const double r = k.spacing() * std::sqrt(double(x * x + y * y + z * z));
        sum.value += k.value(r);
        sum.slope += k.gradientOverR(r) * x * k.spacing();
      }
  return sum;
}

TEST_P(HalfSpaceTest, CompletesTheRestLattice) {
  const SmoothingKernel k = kernel();
  const HalfSpaceTable table = rill::makeHalfSpaceTable(k);
  for (int layer = 0; layer < 4; ++layer) {
    const double s = (layer + 0.5) * kHalfSpacing;
    const LineSample missing = layersFrom(k, layer + 1), exact = rill::exactPlane(k, s), tabulated = table.sample(s);
    EXPECT_NEAR(exact.value, missing.value, 1e-12);
    EXPECT_NEAR(exact.slope, missing.slope, 1e-12 / kHalfSpacing);
    EXPECT_NEAR(tabulated.value, missing.value, 2e-6);
    EXPECT_NEAR(tabulated.slope * kHalfSpacing, missing.slope * kHalfSpacing, 1e-5);
  }
}

TEST_P(HalfSpaceTest, IncreasesTowardItsSurface) {
  const SmoothingKernel k = kernel();
  const HalfSpaceTable table = rill::makeHalfSpaceTable(k);
  const double reach = rill::solidReach(k);
  for (int i = 0; i < 100; ++i) {
    const LineSample near = rill::exactPlane(k, reach * i / 100), far = rill::exactPlane(k, reach * (i + 1) / 100);
    EXPECT_GT(near.value, far.value);
    EXPECT_LT(near.slope, 0);
  }
  for (const double s : {reach, 1.01 * reach, 50.0, kFar}) {
    EXPECT_EQ(rill::exactPlane(k, s).value, 0);
    EXPECT_NEAR(table.sample(s).value, 0, 1e-5);
  }
  const LineSample inside = rill::exactPlane(k, -0.3 * kHalfSpacing), surface = rill::exactPlane(k, 0);
  EXPECT_EQ(inside.value, surface.value);
}

TEST_P(HalfSpaceTest, IsContinuousMonotoneAndMatchesLayers) {
  const SmoothingKernel k = kernel();
  const HalfSpaceTable table = rill::makeHalfSpaceTable(k);
  const double reach = rill::solidReach(k), step = 1e-6 * kHalfSpacing;
  EXPECT_NEAR(rill::halfSpace(k, 0).value, 0.5, 1e-14);
  double last = 1;
  for (int i = -100; i <= 100; ++i) {
    const double s = reach * i / 100 * (1 - 1e-6);
    const LineSample f = rill::halfSpace(k, s);
    EXPECT_LE(f.value, last + 1e-15);
    last = f.value;
    EXPECT_NEAR(f.value + rill::halfSpace(k, -s).value, 1, 1e-14);
    EXPECT_NEAR(rill::halfSpace(k, s + step).value, rill::halfSpace(k, s - step).value, 1e-5);
    EXPECT_NEAR(f.value, table.sample(s).value, ratio() < 2 ? 5e-3 : 1e-3);
    EXPECT_NEAR(f.slope * kHalfSpacing, table.sample(s).slope * kHalfSpacing, ratio() < 2 ? 1.5e-2 : 3e-3);
    if (s >= kHalfSpacing / 2) { EXPECT_EQ(f.value, rill::exactPlane(k, s).value); }
  }
}

INSTANTIATE_TEST_SUITE_P(All, HalfSpaceTest,
                         testing::Combine(testing::Values(KernelChoice::Wendland, KernelChoice::Poly6Spiky),
                                          testing::Values(1.2, 1.5, 2.0, 2.5, 3.0, 3.7, 4.0)));

/// The scale times a vector.
std::array<double, 3> scaled(const rill::SolidScale& s, const Double3& v) {
  return {s.diagonal[0] * v[0] + s.mixed[2] * v[1] + s.mixed[1] * v[2], s.mixed[2] * v[0] + s.diagonal[1] * v[1] + s.mixed[0] * v[2],
          s.mixed[1] * v[0] + s.mixed[0] * v[1] + s.diagonal[2] * v[2]};
}

TEST(SolidScale, ScalesAlongASurfaceOfAnyNormal) {
  std::mt19937 random(3);
  std::normal_distribution<double> part;
  for (int n = 0; n < 100; ++n) {
    Double3 normal = {part(random), part(random), part(random)}, along = {part(random), part(random), part(random)};
    const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    const double out = (normal[0] * along[0] + normal[1] * along[1] + normal[2] * along[2]) / square;
    for (int a = 0; a < 3; ++a) along[a] -= out * normal[a];
    for (const double b : {0.125, 0.39, 0.9}) {
      SolidSample sample;
      sample.cover(b, normal);
      const rill::SolidScale scale = rill::solidScale(sample);
      const double wanted = 1 / (1 - std::min(b, 0.4));
      for (size_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(scaled(scale, along)[a], wanted * along[a], 1e-6) << b;
        EXPECT_NEAR(scaled(scale, normal)[a], normal[a], 1e-6) << b;
      }
    }
  }
}

// Two surfaces that meet: along the edge both count, across one of them the other alone.
TEST(SolidScale, AddsTheSurfacesOfATurnedEdge) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Double3 first = {c, s, 0}, second = {-s, c, 0}, edge = {0, 0, 1};
  SolidSample sample;
  sample.cover(0.125, first);
  sample.cover(0.2, second);
  const rill::SolidScale scale = rill::solidScale(sample);
  for (size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(scaled(scale, first)[a], first[a] / (1 - 0.2), 1e-9);
    EXPECT_NEAR(scaled(scale, second)[a], second[a] / (1 - 0.125), 1e-9);
    EXPECT_NEAR(scaled(scale, edge)[a], edge[a] / (1 - 0.325), 1e-9);
  }
}

// The pressure force along z of a linear pressure, from the lattice beside faces along x and y, over that in the bulk.
TEST(SolidScale, CoverageIsWhatThePressureForceLacks) {
  for (const double ratio : {2.0, 2.3, 3.0, 4.0}) {
    const SmoothingKernel k(KernelChoice::Wendland, ratio * kHalfSpacing, kHalfSpacing);
    const auto force = [&](int lowX, int lowY) {
      double sum = 0;
      for (int x = lowX; x <= 4; ++x)
        for (int y = lowY; y <= 4; ++y)
          for (int z = -4; z <= 4; ++z) sum -= k.gradientOverR(kHalfSpacing * std::sqrt(double(x * x + y * y + z * z))) * z * z;
      return sum;
    };
    const double coverage = rill::exactPlane(k, kHalfSpacing / 2).value, whole = force(-4, -4);
    EXPECT_NEAR(force(0, -4) / whole, 1 - coverage, 0.02) << "beside a face, h = " << ratio << " d";
    EXPECT_LT(force(0, -4) / whole, 0.9) << "the reduction must be significant for the test";
  }
}

// Coverage above the bound is cut axis by axis or by a common factor: there a small turn of a surface is a step. At h = 2 d no corner is.
TEST(SolidScale, StepsByASmallTurnAboveTheBoundOnly) {
  constexpr double kTurn = 1e-3;  // rad
  const auto step = [](double ratio, int faces) {
    const SmoothingKernel k(KernelChoice::Wendland, ratio * kHalfSpacing, kHalfSpacing);
    const double beside = rill::exactPlane(k, kHalfSpacing / 2).value;
    const auto scale = [&](double turn) {
      SolidSample sample;
      for (int face = 0; face < faces; ++face) sample.cover(beside, {face == 0 ? 1.0 : 0.0, face == 1 ? 1.0 : 0.0, 0});
      sample.cover(beside, {-std::cos(turn), 0, std::sin(turn)});
      return rill::solidScale(sample);
    };
    double most = 0;
    for (size_t a = 0; a < 3; ++a) most = std::max(most, std::abs(scale(kTurn).diagonal[a] / scale(0).diagonal[a] - 1));
    return most;
  };
  EXPECT_LT(step(2, 1), kTurn);
  EXPECT_LT(step(2, 2), kTurn);
  EXPECT_GT(step(4, 2), 0.01) << "the step must be there for the test";
}

}  // namespace
