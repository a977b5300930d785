#include "sph/wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

namespace {

using rill::Double3;
using rill::KernelChoice;
using rill::LineSample;
using rill::SmoothingKernel;
using rill::WallSample;
using rill::WallTables;

constexpr double kWallSpacing = 0.02, kFar = std::numeric_limits<double>::infinity();

class WallTest : public testing::TestWithParam<std::tuple<KernelChoice, double>> {
 protected:
  SmoothingKernel kernel() const { return SmoothingKernel(std::get<0>(GetParam()), std::get<1>(GetParam()) * kWallSpacing, kWallSpacing); }
  double ratio() const { return std::get<1>(GetParam()); }
};

/// Largest |rho/rho0 - 1| and largest constraint gradient times d in a full rest lattice of `layers` in a box. Axes with 0 layers are
/// unbounded, the others have walls on both sides.
struct Rest {
  double density = 0, gradient = 0;
};

template <class Wall>
Rest restLattice(const SmoothingKernel& k, const int (&layers)[3], const Wall& wall) {
  const double d = k.spacing();
  const int reach = static_cast<int>(std::ceil(k.h() / d));
  Rest worst;
  int count[3], p[3], n[3];
  for (int a = 0; a < 3; ++a) count[a] = std::max(layers[a], 1);
  for (p[0] = 0; p[0] < count[0]; ++p[0])
    for (p[1] = 0; p[1] < count[1]; ++p[1])
      for (p[2] = 0; p[2] < count[2]; ++p[2]) {
        Double3 lo, hi;
        for (int a = 0; a < 3; ++a) {
          lo[a] = layers[a] ? (p[a] + 0.5) * d : kFar;
          hi[a] = layers[a] ? (layers[a] - p[a] - 0.5) * d : kFar;
        }
        const WallSample w = wall(lo, hi);
        double sum = w.value, g[3] = {w.gradient[0], w.gradient[1], w.gradient[2]};
        for (n[0] = -reach; n[0] <= reach; ++n[0])
          for (n[1] = -reach; n[1] <= reach; ++n[1])
            for (n[2] = -reach; n[2] <= reach; ++n[2]) {
              bool inBox = true;
              for (int a = 0; a < 3; ++a) inBox = inBox && (!layers[a] || (p[a] + n[a] >= 0 && p[a] + n[a] < layers[a]));
              if (!inBox) continue;
              const double r = d * std::sqrt(double(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
              sum += k.value(r);
              for (int a = 0; a < 3; ++a) g[a] -= k.gradientOverR(r) * d * n[a];
            }
        worst.density = std::max(worst.density, std::abs(sum - 1));
        worst.gradient = std::max(worst.gradient, d * std::hypot(g[0], g[1], g[2]));
      }
  return worst;
}

TEST_P(WallTest, RestLatticeHasRestDensityEverywhere) {
  const SmoothingKernel k = kernel();
  const WallTables tables = rill::makeWallTables(k);
  const int boxes[][3] = {{10, 0, 0}, {10, 10, 0}, {6, 6, 6}, {10, 9, 10}, {1, 0, 0},
                          {2, 0, 0},  {3, 5, 0},   {4, 4, 4}, {1, 1, 1},   {2, 1, 3}};
  for (const auto& layers : boxes) {
    const auto name = testing::Message() << layers[0] << " x " << layers[1] << " x " << layers[2] << " layers";
    const Rest exact = restLattice(k, layers, [&](const Double3& lo, const Double3& hi) { return rill::exactWall(k, lo, hi); });
    EXPECT_LT(exact.density, 1e-12) << name;
    EXPECT_LT(exact.gradient, 1e-12) << name;
    const Rest tabulated = restLattice(k, layers, [&](const Double3& lo, const Double3& hi) { return tables.sample(lo, hi); });
    EXPECT_LT(tabulated.density, 2e-6) << name;
    EXPECT_LT(tabulated.gradient, 1e-5) << name;
  }
}

TEST_P(WallTest, TablesMatchLatticeSums) {
  const SmoothingKernel k = kernel();
  const WallTables tables = rill::makeWallTables(k);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> distance(0, 1.1 * rill::wallReach(k));
  std::uniform_int_distribution<int> closed(0, 1);
  // The error of linear interpolation is step^2 / 8 times the curvature, which is larger for narrow kernels.
  const double bound = ratio() < 2 ? 5e-3 : ratio() < 3 ? 1.3e-3 : 5e-4;
  for (int sample = 0; sample < 2000; ++sample) {
    Double3 lo, hi;
    for (int a = 0; a < 3; ++a) {
      lo[a] = closed(random) ? distance(random) : kFar;
      hi[a] = closed(random) && sample % 4 == 0 ? distance(random) : kFar;
    }
    const WallSample exact = rill::exactWall(k, lo, hi), table = tables.sample(lo, hi);
    const double terms = sample % 4 == 0 ? 4 : 1;  // both walls of an axis near: more terms
    EXPECT_NEAR(exact.value, table.value, terms * bound);
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(exact.gradient[a] * kWallSpacing, table.gradient[a] * kWallSpacing, terms * 4 * bound);
      EXPECT_NEAR(exact.wallCoverage[a], table.wallCoverage[a], terms * bound);
    }
  }
}

TEST_P(WallTest, IncreasesTowardWall) {
  const SmoothingKernel k = kernel();
  const WallTables tables = rill::makeWallTables(k);
  const double reach = rill::wallReach(k);
  for (int i = 0; i < 100; ++i) {
    const double s = reach * i / 100;
    const LineSample near = rill::exactPlane(k, s), far = rill::exactPlane(k, reach * (i + 1) / 100);
    EXPECT_GT(near.value, far.value);
    EXPECT_LT(near.slope, 0);
    const Double3 lo = {kFar, s, kFar}, hi = {kFar, kFar, kFar};
    const WallSample low = rill::exactWall(k, lo, hi), high = rill::exactWall(k, hi, lo);
    EXPECT_NEAR(low.value, near.value, 1e-14);
    EXPECT_NEAR(low.gradient[1], near.slope, 1e-12 / kWallSpacing);
    EXPECT_NEAR(high.gradient[1], -near.slope, 1e-12 / kWallSpacing);
    EXPECT_EQ(low.gradient[0], 0);
    EXPECT_EQ(low.wallCoverage[1], 0) << "a wall perpendicular to the axis does not cover it";
    EXPECT_NEAR(low.wallCoverage[0], near.value, 1e-14);
  }
  for (const double s : {reach, 1.01 * reach, 50.0, kFar}) {
    EXPECT_EQ(rill::exactPlane(k, s).value, 0);
    EXPECT_NEAR(tables.samplePlane(s).value, 0, 1e-5);
  }
  const LineSample inside = rill::exactPlane(k, -0.3 * kWallSpacing), surface = rill::exactPlane(k, 0);
  EXPECT_EQ(inside.value, surface.value);
}

TEST_P(WallTest, HalfSpaceIsContinuousMonotoneAndMatchesPlane) {
  const SmoothingKernel k = kernel();
  const WallTables tables = rill::makeWallTables(k);
  const double reach = rill::wallReach(k), step = 1e-6 * kWallSpacing;
  EXPECT_NEAR(rill::halfSpace(k, 0).value, 0.5, 1e-14);
  double last = 1;
  for (int i = -100; i <= 100; ++i) {
    const double s = reach * i / 100 * (1 - 1e-6);
    const LineSample f = rill::halfSpace(k, s);
    EXPECT_LE(f.value, last + 1e-15);
    last = f.value;
    EXPECT_NEAR(f.value + rill::halfSpace(k, -s).value, 1, 1e-14);
    EXPECT_NEAR(rill::halfSpace(k, s + step).value, rill::halfSpace(k, s - step).value, 1e-5);
    EXPECT_NEAR(f.value, tables.sampleFace(s).value, ratio() < 2 ? 5e-3 : 1e-3);
    EXPECT_NEAR(f.slope * kWallSpacing, tables.sampleFace(s).slope * kWallSpacing, ratio() < 2 ? 1.5e-2 : 3e-3);
    if (s >= kWallSpacing / 2) { EXPECT_EQ(f.value, rill::exactPlane(k, s).value); }
  }
}

INSTANTIATE_TEST_SUITE_P(All, WallTest,
                         testing::Combine(testing::Values(KernelChoice::Wendland, KernelChoice::Poly6Spiky),
                                          testing::Values(1.2, 1.5, 2.0, 2.5, 3.0, 3.7, 4.0)));

TEST(WendlandWall, GradientIsTheDerivativeOfTheValue) {
  std::mt19937 random(11);
  for (const double ratio : {1.2, 2.0, 3.0}) {
    const SmoothingKernel k(KernelChoice::Wendland, ratio * kWallSpacing, kWallSpacing);
    std::uniform_real_distribution<double> distance(0.01 * kWallSpacing, k.h());
    for (int sample = 0; sample < 50; ++sample) {
      Double3 lo, hi;
      for (int a = 0; a < 3; ++a) lo[a] = distance(random), hi[a] = sample % 2 ? distance(random) : kFar;
      const WallSample at = rill::exactWall(k, lo, hi);
      for (int a = 0; a < 3; ++a) {
        const double step = 1e-5 * kWallSpacing;
        double value[2];
        for (int side = 0; side < 2; ++side) {
          Double3 l = lo, u = hi;
          const double move = side ? step : -step;
          l[a] += move, u[a] -= move;
          value[side] = rill::exactWall(k, l, u).value;
        }
        EXPECT_NEAR(at.gradient[a] * kWallSpacing, (value[1] - value[0]) / (2 * step) * kWallSpacing, 1e-6);
      }
    }
  }
}

// The pressure force along z of a linear pressure, from the lattice at an edge and in the edge of a gap, over that in the bulk.
TEST(WendlandWall, PressureForceAlongWallIsReducedByCoverage) {
  for (const double ratio : {2.0, 2.3, 3.0, 4.0}) {
    const SmoothingKernel k(KernelChoice::Wendland, ratio * kWallSpacing, kWallSpacing);
    const auto force = [&](int columns, int rows) {
      double sum = 0;
      for (int x = -4; x <= 4; ++x)
        for (int y = -4; y <= 4; ++y)
          for (int z = -4; z <= 4; ++z)
            if (x >= 0 && y >= 0 && x < columns && y < rows)
              sum -= k.gradientOverR(kWallSpacing * std::sqrt(double(x * x + y * y + z * z))) * z * z;
      return sum;
    };
    double whole = 0;
    for (int x = -4; x <= 4; ++x)
      for (int y = -4; y <= 4; ++y)
        for (int z = -4; z <= 4; ++z) whole -= k.gradientOverR(kWallSpacing * std::sqrt(double(x * x + y * y + z * z))) * z * z;
    const double near = kWallSpacing / 2;
    const auto coverage = [&](double lowY, double highX) {
      const Double3 lo = {near, lowY, kFar}, hi = {highX, kFar, kFar};
      return rill::exactWall(k, lo, hi).wallCoverage[2];
    };
    EXPECT_NEAR(force(9, 9) / whole, 1 - coverage(near, kFar), 0.02) << "in an edge, h = " << ratio << " d";
    EXPECT_NEAR(force(1, 9) / whole, 1 - coverage(near, near), 0.03) << "in the edge of a gap one layer wide, h = " << ratio << " d";
    EXPECT_LT(force(9, 9) / whole, 0.8) << "the reduction must be significant for the test";
  }
}

TEST(WallTables, StaySmallAtTheWidestKernel) {
  const WallTables t = rill::makeWallTables(SmoothingKernel(KernelChoice::Wendland, 4 * kWallSpacing, kWallSpacing));
  const size_t bytes = sizeof(float) * (t.plane.size() + t.face.size() + t.edge.size() + t.corner.size());
  EXPECT_LT(bytes, 300u << 10);
  EXPECT_EQ(t.edge.size(), size_t(2) * t.nodes * t.nodes);
  EXPECT_EQ(t.corner.size(), size_t(2) * t.cornerNodes * t.cornerNodes * t.cornerNodes);
}

/// The scale times a vector.
std::array<double, 3> scaled(const rill::WallScale& s, const Double3& v) {
  return {s.diagonal[0] * v[0] + s.mixed[2] * v[1] + s.mixed[1] * v[2], s.mixed[2] * v[0] + s.diagonal[1] * v[1] + s.mixed[0] * v[2],
          s.mixed[1] * v[0] + s.mixed[0] * v[1] + s.diagonal[2] * v[2]};
}

TEST(WallScale, ScalesAlongAWallOfAnyNormal) {
  std::mt19937 random(3);
  std::normal_distribution<double> part;
  for (int n = 0; n < 100; ++n) {
    Double3 normal = {part(random), part(random), part(random)}, along = {part(random), part(random), part(random)};
    const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    const double out = (normal[0] * along[0] + normal[1] * along[1] + normal[2] * along[2]) / square;
    for (int a = 0; a < 3; ++a) along[a] -= out * normal[a];
    for (const double b : {0.125, 0.39, 0.9}) {
      WallSample sample;
      sample.cover(b, normal);
      const rill::WallScale scale = rill::wallScale(sample);
      const double wanted = 1 / (1 - std::min(b, 0.4));
      for (size_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(scaled(scale, along)[a], wanted * along[a], 1e-6) << b;
        EXPECT_NEAR(scaled(scale, normal)[a], normal[a], 1e-6) << b;
      }
    }
  }
}

// Two walls that meet: along the edge both count, across one wall the other alone.
TEST(WallScale, AddsTheWallsOfATurnedEdge) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Double3 first = {c, s, 0}, second = {-s, c, 0}, edge = {0, 0, 1};
  WallSample sample;
  sample.cover(0.125, first);
  sample.cover(0.2, second);
  const rill::WallScale scale = rill::wallScale(sample);
  for (size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(scaled(scale, first)[a], first[a] / (1 - 0.2), 1e-9);
    EXPECT_NEAR(scaled(scale, second)[a], second[a] / (1 - 0.125), 1e-9);
    EXPECT_NEAR(scaled(scale, edge)[a], edge[a] / (1 - 0.325), 1e-9);
  }
}

// Coverage above the bound is cut axis by axis or by a common factor: there a small turn of a wall is a step. At h = 2 d no corner is.
TEST(WallScale, StepsByASmallTurnAboveTheBoundOnly) {
  constexpr double kTurn = 1e-3, kNear = kWallSpacing / 2;  // rad, m
  const auto step = [](double ratio, double slot) {
    const SmoothingKernel k(KernelChoice::Wendland, ratio * kWallSpacing, kWallSpacing);
    const WallSample walls = rill::exactWall(k, {slot, kNear, kNear}, {kFar, kFar, kFar});
    const double behind = rill::exactWall(k, {kNear, kFar, kFar}, {kFar, kFar, kFar}).value;  // a face of a box
    const auto scale = [&](double turn) {
      WallSample sample = walls;
      sample.cover(behind, {-std::cos(turn), 0, std::sin(turn)});
      return rill::wallScale(sample);
    };
    double most = 0;
    for (size_t a = 0; a < 3; ++a) most = std::max(most, std::abs(scale(kTurn).diagonal[a] / scale(0).diagonal[a] - 1));
    return most;
  };
  EXPECT_LT(step(2, kFar), kTurn);
  EXPECT_LT(step(2, kNear), kTurn) << "in a slot one layer wide";
  EXPECT_NEAR(step(3, kFar), 0.076, 0.001);
  EXPECT_NEAR(step(4, kFar), 0.094, 0.001);
  EXPECT_NEAR(step(2.3, kNear), 0.080, 0.001);
  EXPECT_NEAR(step(4, kNear), 0.199, 0.001);
}

}  // namespace
