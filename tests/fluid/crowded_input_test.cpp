// Coincident and crushed particles: full cells, full lists, walks that are too long.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fluid/degenerate_input.hpp"
#include "sort/sort_types.h"

namespace rill::test {
namespace degenerate_input_test {

double nearestPair(const std::vector<glm::dvec3>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < x.size(); ++i)
    for (size_t j = 0; j < i; ++j) least = std::min(least, glm::length(x[i] - x[j]));
  return least;
}

bool eachIdOnce(const FluidSnapshot& s) {
  std::vector<bool> seen(s.id.size());
  for (uint32_t id : s.id) {
    if (id >= seen.size() || seen[id]) return false;
    seen[id] = true;
  }
  return true;
}

double speeds(const Snapshot& s) {
  double sum = 0;
  for (const glm::dvec3& v : s.v) sum += glm::length(v);
  return sum;
}

// A cell with more particles than the sort looks through for each: it is put in order in another way.
TEST_F(DegenerateInputTest, HandlesThousandsOfParticlesInOneCell) {
  Trial t = trial();
  t.x = randomCloud(3000, 0.4 * t.d(), 7, {0.01, 0.01, 0.01});
  for (const glm::dvec3& x : block({6, 6, 6}, t.d(), {0.5, 0, 0})) t.x.push_back(x);
  ASSERT_GT(t.x.size(), size_t{5} * kBinLimit);
  Snapshot first;
  for (Gather gather : kGathers) {
    SCOPED_TRACE(nameOf(gather));
    t.gather = gather;
    auto run = start(t), again = start(t);
    run->substeps(3);
    again->substeps(3);
    const Snapshot s = run->snapshot();
    EXPECT_TRUE(s.finite());
    EXPECT_EQ(s, again->snapshot());
    EXPECT_TRUE(eachIdOnce(run->saved()));
    EXPECT_EQ(run->stats().nonFinite, 0u);
  }
}

// So many particles a cell that the fluid's sort is the one by digits.
TEST_F(DegenerateInputTest, SortsFullCellsByDigits) {
  Trial t = trial();
  t.x = randomCloud(3000, 2 * t.d(), 11);
  for (Gather gather : kGathers) {
    SCOPED_TRACE(nameOf(gather));
    t.gather = gather;
    auto run = start(t), again = start(t);
    const FluidSetup& setup = implOf(run->fluid()).setup;
    ASSERT_EQ(chooseSortMethod({.count = setup.params.capacity, .keyRange = setup.grid.cells(), .start = true}), SortMethod::Radix);
    run->substeps(2);
    again->substeps(2);
    EXPECT_TRUE(run->snapshot().finite());
    EXPECT_EQ(run->snapshot(), again->snapshot());
    EXPECT_TRUE(eachIdOnce(run->saved()));
    EXPECT_EQ(run->stats().nonFinite, 0u);
  }
}

// Forces between two particles are opposite: what the sum of velocities may change by is the rounding of positions (2^-24 of the few
// spacings that the cluster spans, over the step), for every particle and substep.
TEST_F(DegenerateInputTest, SeparatesCoincidentParticles) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.solver.cfl = 10;  // the bound on the speed acts on each particle alone
  t.x.assign(40, glm::dvec3(0));
  for (Gather gather : kGathers) {
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t);
    run->substeps(1);
    EXPECT_GT(nearestPair(run->snapshot().x), 0);
    run->substeps(4);
    const Snapshot s = run->snapshot();
    ASSERT_TRUE(s.finite());
    EXPECT_GT(nearestPair(s.x), 0.1 * t.d());
    EXPECT_LE(glm::length(s.velocitySum()), 1e-5 * speeds(s));
  }
}

// More of them than a list holds.
TEST_F(DegenerateInputTest, SeparatesManyCoincidentParticles) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.x.assign(300, glm::dvec3(0.4));
  t.scene.solver.cfl = 0.25;
  auto run = start(t);
  run->substeps(50);
  const Snapshot s = run->snapshot();
  ASSERT_TRUE(s.finite());
  EXPECT_GT(nearestPair(s.x), 0.01 * t.d());
  EXPECT_EQ(outsideOf(t, s), 0u);
}

// A block with a hundred times the rest density. A substep moves no particle farther than twice what cfl allows, half a spacing, and may be
// half as long as the one before: four of them take a particle out of the reach of all others, with at most 2^4 times half a spacing a
// first step. It has flown apart after the first advance; from then on gravity alone adds to the fastest particle's speed.
TEST_F(DegenerateInputTest, CompressedBlockStaysInsideAtABoundedSpeed) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.x = randomCloud(400, std::cbrt(4.0) * t.d(), 3, glm::dvec3(0.3));
  t.scene.solver.cfl = 0.25;
  for (Gather gather : kGathers) {
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t);
    std::vector<double> speed;
    for (int n = 0; n < 5; ++n) {
      run->advance(0.01);
      const Snapshot s = run->snapshot();
      ASSERT_TRUE(s.finite());
      EXPECT_EQ(outsideOf(t, s), 0u);
      speed.push_back(s.fastest());
      EXPECT_LT(speed.back(), 16 * 0.5 * t.d() / t.step);
    }
    EXPECT_LT(speed.back(), speed.front() + 4 * 0.01 * 9.81);
  }
}

TEST_F(DegenerateInputTest, FullListsFallBackToTheGrid) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.x = randomCloud(400, 5 * t.d(), 7, glm::dvec3(0.03));
  t.v = randomCloud(400, 1.0, 8, glm::dvec3(-0.5));
  auto listed = start(t);
  listed->substeps(1);
  EXPECT_GT(listed->stats().neighborOverflow, 0u);
  t.gather = Gather::Grid;
  auto walked = start(t);
  walked->substeps(1);
  EXPECT_EQ(walked->stats().neighborOverflow, 0u);
  const Snapshot a = listed->snapshot(), b = walked->snapshot();
  for (size_t i = 0; i < a.x.size(); ++i) EXPECT_LT(glm::length(a.x[i] - b.x[i]), 2e-4 * t.d()) << i;
  t.gather = Gather::Texel;
  expectEqual(t, 1, 1e-3, 1e-3);
}

// Lists that overflow at first and fit once the fluid has spread: the device switches between the two variants of every pass over
// neighbors.
TEST_F(DegenerateInputTest, HandlesListsThatOverflowForAWhile) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solver.iterations = 2;
  t.scene.fluid.viscosity = 1;
  t.scene.fluid.vorticity = 0.2;
  t.x = randomCloud(400, 5 * t.d(), 7, glm::dvec3(0.03));
  t.v.assign(400, glm::dvec3(0));
  const auto after = [&](int substeps, uint32_t piece, uint64_t& overflow) {
    auto run = start(t);
    run->substeps(substeps, piece);
    overflow = run->stats().neighborOverflow;
    return run->snapshot();
  };
  constexpr int kLong = 60;
  uint64_t early = 0, late = 0;
  (void)after(1, 64, early);
  const Snapshot whole = after(kLong, 64, late);
  EXPECT_GT(early, 0u);
  EXPECT_EQ(late, 0u) << "spread";
  EXPECT_TRUE(whole.finite());
  EXPECT_EQ(whole, after(kLong, 6, late)) << "in pieces";
  t.scene.solver.iterations = 1;  // of two, the second would move them by more than the list's skin
  const Snapshot listed = after(1, 64, late);
  t.gather = Gather::Grid;
  const Snapshot walked = after(1, 64, late);
  for (size_t i = 0; i < listed.x.size(); ++i) EXPECT_LT(glm::length(listed.x[i] - walked.x[i]), 1e-3 * t.d()) << i;
}

// More particles in one cell than a walk looks at: it ends, and says so. They are inactive (a start that is not finite), which puts them
// all into the first cell of the wrapped grid but lets none of them walk: one cluster alone has the long way, so that this is quick on
// every driver.
TEST_F(DegenerateInputTest, BoundsNeighborSearchAndCountsIt) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.x.assign(40000, glm::dvec3(NAN));
  t.x.push_back(glm::dvec3(0.01));
  t.v.assign(t.x.size(), glm::dvec3(0));
  auto run = start(t);
  run->substeps(1);
  const FluidStats stats = run->stats();
  EXPECT_GT(stats.loopBoundHits, 0u);
  EXPECT_EQ(stats.nonFinite, 40000u);
  EXPECT_LT(glm::length(run->snapshot().x.back() - t.x.back()), 1e-6) << "alone";

  t.x.erase(t.x.begin(), t.x.begin() + 20000);
  t.v.resize(t.x.size());
  auto fewer = start(t);
  fewer->substeps(1);
  EXPECT_EQ(fewer->stats().loopBoundHits, 0u) << "within the bound";
}

}  // namespace degenerate_input_test
}  // namespace rill::test
