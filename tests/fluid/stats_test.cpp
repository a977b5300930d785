// The figures against sums over the particles that came back with them, in double precision; densities by looking at every pair.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"

namespace rill::test {
namespace stats_test {

// What the figures should be.
struct Sums {
  std::vector<double> density;
  double mean = 0, p99 = 0, max = 0, median = 0;
  double kinetic = 0, potential = 0, fastest = 0;
  glm::dvec3 momentum = glm::dvec3(0), center = glm::dvec3(0);
};

class StatsTest : public FluidTest {
 protected:
  static Sums sumsOf(const Trial& t, const Snapshot& s) {
    Sums sums;
    const SmoothingKernel kernel(t.scene.solver.kernel, t.scene.fluid.smoothing_ratio * t.d(), t.d());
    Oracle oracle(t);
    oracle.solver().state.predicted = s.x;
    oracle.solver().density();
    const double full = std::floor(0.8 * 4.0 / 3.0 * 3.14159265358979 * std::pow(t.scene.fluid.smoothing_ratio, 3));
    const double mass = t.scene.fluid.density * std::pow(t.d(), 3), n = double(s.x.size());
    std::vector<double> compression, inside;
    for (size_t i = 0; i < s.x.size(); ++i) {
      const double rho = oracle.solver().densityRatio()[i];
      int neighbors = -1;
      for (const glm::dvec3& other : s.x) neighbors += glm::length(s.x[i] - other) < kernel.h();
      sums.density.push_back(rho);
      compression.push_back(std::max(rho - 1, 0.0));
      if (neighbors >= full) inside.push_back(rho - 1);
      sums.mean += compression.back() / n;
      sums.kinetic += 0.5 * mass * glm::dot(s.v[i], s.v[i]);
      sums.momentum += mass * s.v[i];
      for (int a = 0; a < 3; ++a) {
        const double place = s.x[i][a] + t.origin[a];
        sums.potential -= mass * t.scene.gravity[a] * place;
        sums.center[a] += place / n;
      }
    }
    std::sort(compression.begin(), compression.end());
    std::sort(inside.begin(), inside.end());
    sums.max = compression.back();
    sums.p99 = compression[(compression.size() * 99 + 99) / 100 - 1];
    if (!inside.empty()) sums.median = inside[(inside.size() + 1) / 2 - 1];
    sums.fastest = s.fastest();
    return sums;
  }

  // Floats added up in a tree, and percentiles from bins a 512th of an octave wide. `own`: of a density.
  void expectLike(const Trial& t, Run& run, double own = 1e-5) {
    const FluidStats stats = run.stats();
    const Snapshot& s = run.measured();
    const Sums sums = sumsOf(t, s);
    for (size_t i = 0; i < s.x.size(); ++i) EXPECT_NEAR(s.density[i], sums.density[i], own * std::max(1.0, sums.density[i])) << i;
    EXPECT_EQ(stats.particles, t.x.size());
    EXPECT_NEAR(stats.densityErrorMean, sums.mean, own + 1e-5 * sums.mean);
    EXPECT_NEAR(stats.densityErrorP99, sums.p99, own + sums.p99 / 512);
    EXPECT_NEAR(stats.densityErrorMax, sums.max, own + 1e-5 * sums.max);
    EXPECT_NEAR(stats.densitySignedMedian, sums.median, own + std::abs(sums.median) / 512);
    EXPECT_NEAR(stats.kinetic_J, sums.kinetic, 1e-5 * sums.kinetic);
    const double mass = t.scene.fluid.density * std::pow(t.d(), 3) * double(t.x.size());
    EXPECT_NEAR(stats.potential_J, sums.potential, 1e-5 * mass * 9.81 + 1e-7 * std::abs(sums.potential));
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(stats.momentum[a], sums.momentum[a], 1e-5 * mass * sums.fastest) << a;
      EXPECT_NEAR(stats.centerOfMass[a], sums.center[a], 1e-6) << a;
    }
    EXPECT_NEAR(stats.maxSpeed, sums.fastest, 1e-6 * sums.fastest);
  }
};

TEST_F(StatsTest, MatchesReferenceInACompressedCloud) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.x = randomCloud(500, 6 * t.d(), 21, glm::dvec3(0.03));
  t.v = randomCloud(500, 3.0, 22, {-1, -1, -2});
  t.scene.gravity[0] = 2;
  t.scene.solver.cfl = 0.25;
  auto run = start(t);
  expectLike(t, *run);
  run->substeps(2);
  expectLike(t, *run);
}

TEST_F(StatsTest, MatchesReferenceWithoutWallsFarFromZero) {
  Trial t = trial();
  t.origin[0] = 1000;
  t.origin[1] = -500;
  t.x = randomCloud(400, 7 * t.d(), 31, glm::dvec3(-0.2));
  t.v = randomCloud(400, 3.0, 32, {-1, -1, -2});
  expectLike(t, *start(t));
}

TEST_F(StatsTest, MatchesReferenceWithOtherKernelAndSupport) {
  Trial t = trial();
  t.scene.solver.kernel = KernelChoice::Poly6Spiky;
  t.scene.fluid.smoothing_ratio = 2.6;
  setWalls(t, {1, 1, 1});
  t.x = randomCloud(500, 7 * t.d(), 41, glm::dvec3(0.03));
  expectLike(t, *start(t));
}

TEST_F(StatsTest, MatchesReferenceAroundSolids) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solids = {slab({0.3, 0.2, 0.3}, {0.7, 0.4, 0.7}), ball({0.5, 0.8, 0.5}, 0.125)};
  t.x = block({7, 5, 7}, t.d(), {0.28, 0.4, 0.28}, 0.2);
  expectLike(t, *start(t));
}

// The walls stand in for the lattice beyond them: every particle with a full neighborhood of fluid and walls has the rest density, those
// at the free faces less.
TEST_F(StatsTest, MatchesReferenceForARestLatticeInACorner) {
  Trial t = trial();
  setWalls(t, {6 * t.d(), 6 * t.d(), 6 * t.d()});
  t.x = block({6, 6, 6}, t.d());
  auto run = start(t);
  const FluidStats full = run->stats();
  for (double density : run->measured().density) EXPECT_NEAR(density, 1, 1e-5);
  EXPECT_LT(full.densityErrorMax, 1e-5);
  EXPECT_LT(std::abs(full.densitySignedMedian), 1e-5);

  setWalls(t, {1, 1, 1});
  run = start(t);
  const FluidStats corner = run->stats();
  EXPECT_LT(corner.densityErrorMax, 1e-5);
  for (size_t i = 0; i < t.x.size(); ++i) {
    const bool buried = std::max({t.x[i].x, t.x[i].y, t.x[i].z}) < 4 * t.d();
    EXPECT_LT(run->measured().density[i], 1 + 1e-5) << i;
    EXPECT_GT(run->measured().density[i], buried ? 1 - 1e-5 : 0.5) << i;
  }
  EXPECT_EQ(corner.kinetic_J, 0);
  EXPECT_EQ(corner.maxSpeed, 0);
  EXPECT_NEAR(corner.centerOfMass[1], 3 * t.d(), 1e-6);
}

// 0.1 of 300: the 99th percentile leaves out the three that are worst.
TEST_F(StatsTest, PercentileCountsAFewLargeErrors) {
  Trial t = trial();
  t.scene.fluid.smoothing_ratio = 2;  // three particles at one place are dense
  t.scene.gravity[1] = 0;
  for (int i = 0; i < 297; ++i) t.x.push_back({4.0 * t.d() * (i % 27), 4.0 * t.d() * (i / 27), 0});
  for (int i = 0; i < 3; ++i) t.x.push_back({-1 - 0.01 * i, 0, 0});
  auto run = start(t);
  const FluidStats stats = run->stats();
  const SmoothingKernel kernel(t.scene.solver.kernel, 2 * t.d(), t.d());
  EXPECT_NEAR(stats.densityErrorMax, kernel.value(0) + 2 * kernel.value(0.01) - 1, 1e-5);
  EXPECT_EQ(stats.densityErrorP99, 0);
  t.x.push_back({-1 - 0.02, 0, 0});
  run = start(t);
  EXPECT_GT(run->stats().densityErrorP99, 0.1);
}

}  // namespace stats_test
}  // namespace rill::test
