// A fluid with room for more particles than it has.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <random>

#include "fluid/rig.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace capacity_test {

Trial tank(glm::ivec3 count = {7, 6, 5}) {
  Trial t = trial();
  setWalls(t, {0.75, 1, 0.5});
  t.x = block(count, t.d(), {0.06, 0.06, 0.06}, 0.05);
  t.scene.fluid.viscosity = 0.05;
  t.scene.fluid.vorticity = 0.1;
  return t;
}

/// Those that the particles decide; all are 0 without any.
std::array<double, 10> figures(const FluidStats& s) {
  return {s.densityErrorMean, s.densityErrorP99, s.densityErrorMax, s.densitySignedMedian, s.kinetic_J,
          s.potential_J,      s.maxSpeed,        double(s.outside), double(s.nonFinite),   double(s.neighborOverflow)};
}

class CapacityTest : public FluidTest {};

TEST_F(CapacityTest, MatchesReferenceWithAnyCapacity) {
  Trial t = tank();
  t.scene.solids = {ball({0.3, 0.6, 0.2}, 0.1)};
  t.scene.solver.iterations = 2;
  for (const uint32_t capacity : {211u, 256u, 257u, 5000u}) {
    SCOPED_TRACE(capacity);
    t.capacity = capacity;
    expectEqual(t, 12, 2e-4, 2e-4);
  }
}

// With so many keys to a cell the sort is by digits, over all of them. Without room to spare it is by counting, and has the same order.
TEST_F(CapacityTest, SortsByDigitsWithRoomToSpare) {
  Trial t = trial();
  t.x = block({24, 24, 24}, t.d(), {}, 0.3);
  std::shuffle(t.x.begin(), t.x.end(), std::mt19937(7));
  t.v = randomCloud(t.x.size(), 8, 3, glm::dvec3(-4));
  setWalls(t, glm::dvec3(24 * t.d()));
  const auto sortedBy = [&](SortMethod method) {
    auto run = start(t);
    const FluidSetup& setup = implOf(run->fluid()).setup;
    EXPECT_EQ(chooseSortMethod({.count = setup.params.capacity, .keyRange = setup.grid.cells(), .start = true}), method);
    run->fillTransients(0);  // a key, unlike NaN
    run->advance(12 * t.step);
    EXPECT_GT(run->progress().listBuilds, 1u);
    return run->saved();
  };
  const FluidSnapshot counted = sortedBy(SortMethod::Counting);
  EXPECT_EQ(counted.id.size(), t.x.size());
  t.capacity = 100000;
  EXPECT_TRUE(sortedBy(SortMethod::Radix) == counted);
}

// A wide support makes long lists, which two buffers share. The particles end in the first of them, or in the second.
TEST_F(CapacityTest, FillsPartOfSeveralLists) {
  for (const int side : {14, 21}) {
    SCOPED_TRACE(side);
    Trial t = trial();
    t.scene.fluid.smoothing_ratio = 4;
    t.scene.fluid.viscosity = 0.05;
    t.scene.fluid.vorticity = 0.1;
    t.scene.solver.iterations = 2;
    t.x = block(glm::ivec3(side), t.d(), {}, 0.1);
    t.v = randomCloud(t.x.size(), 2, 5, glm::dvec3(-1));
    setWalls(t, glm::dvec3(side * t.d()));
    const auto after = [&](size_t lists) {
      auto run = start(t);
      const auto chunks = implOf(run->fluid()).chunks();
      EXPECT_EQ(chunks.size(), lists);
      EXPECT_EQ(chunks.back().first < t.x.size(), lists == 1 || side == 21);
      run->fillTransients(std::bit_cast<uint32_t>(0.5f));  // a place in the fluid
      run->substeps(2);
      return run->saved();
    };
    const FluidSnapshot one = after(1);
    EXPECT_GT(one.neighbors.size(), 100 * t.x.size());
    const Expected<void> fits = checkSnapshot(one, snapshotShape(implOf(start(t)->fluid()).setup));
    EXPECT_TRUE(fits) << fits.error().message;
    t.capacity = 16000;
    const SmallBuffers small(*this, uint64_t{8} << 20);
    EXPECT_TRUE(after(2) == one);
  }
}

TEST_F(CapacityTest, FiguresCountActiveParticlesOnly) {
  Trial t = tank();
  auto exact = start(t);
  exact->substeps(5);
  const FluidStats wanted = exact->stats();
  t.capacity = 4000;
  auto roomy = start(t);
  EXPECT_EQ(roomy->fluid().count(), t.x.size());
  EXPECT_EQ(roomy->fluid().capacity(), 4000u);
  roomy->substeps(5);
  const FluidStats got = roomy->stats();
  EXPECT_EQ(got.particles, t.x.size());
  EXPECT_EQ(got.outside, wanted.outside);
  EXPECT_NEAR(got.densityErrorMean, wanted.densityErrorMean, 1e-5);
  EXPECT_NEAR(got.densitySignedMedian, wanted.densitySignedMedian, 1e-3);
  EXPECT_NEAR(got.kinetic_J, wanted.kinetic_J, 1e-4 * wanted.kinetic_J);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(got.centerOfMass[a], wanted.centerOfMass[a], 1e-5);
}

constexpr uint32_t kGarbage[] = {0xffffffffu, 0, 1, std::bit_cast<uint32_t>(4.1f)};

TEST_F(CapacityTest, ReadsNoTransientBeforeItIsWritten) {
  Trial t = tank();
  t.scene.solids = {ball({0.3, 0.6, 0.2}, 0.1)};
  t.scene.solver.iterations = 2;
  for (const uint32_t capacity : {300u, 5000u}) {
    t.capacity = capacity;
    std::optional<Snapshot> first;
    std::array<double, 10> firstFigures{};
    for (const uint32_t garbage : kGarbage) {
      SCOPED_TRACE(garbage);
      auto run = start(t);
      run->fillTransients(garbage);
      run->substeps(6);
      run->fillTransients(garbage);
      const auto found = figures(run->stats());
      if (!first) first = run->measured(), firstFigures = found;
      EXPECT_TRUE(first->finite());
      EXPECT_EQ(run->measured(), *first);
      EXPECT_EQ(found, firstFigures);
    }
  }
}

TEST_F(CapacityTest, RunsWithoutParticles) {
  Trial t = tank();
  t.x.clear();
  t.capacity = 300;
  std::optional<FluidSnapshot> first;
  for (const uint32_t garbage : kGarbage) {
    SCOPED_TRACE(garbage);
    auto run = start(t);
    run->fillTransients(garbage);
    run->advance(0.05, 64);
    run->fillTransients(garbage);
    const FluidStats stats = run->stats();
    EXPECT_EQ(stats.particles, 0u);
    EXPECT_EQ(figures(stats), (std::array<double, 10>{}));
    EXPECT_NEAR(stats.time_s, 0.05, 1e-6);
    const FluidSnapshot saved = run->saved();
    EXPECT_TRUE(saved.id.empty());
    if (!first) first = saved;
    EXPECT_TRUE(saved == *first);
  }
}

// The state of a fluid goes on in one with more room, with particles that were not there before and with ids that have gaps.
TEST_F(CapacityTest, SnapshotAddsParticles) {
  Trial t = tank();
  auto before = start(t);
  before->substeps(4);
  FluidSnapshot state = before->saved();
  state.id.back() = 500000;
  const std::vector<Float3> more = {{0.1f, 0.8f, 0.1f}, {0.2f, 0.8f, 0.1f}, {0.3f, 0.8f, 0.1f}};
  append(state, more, std::vector<Float3>(more.size()));
  t.capacity = 1000;
  auto after = start(t, &state);
  EXPECT_EQ(after->fluid().count(), t.x.size() + more.size());
  after->substeps(4);
  const FluidSnapshot then = after->saved();
  EXPECT_EQ(then.id.size(), t.x.size() + more.size());
  std::vector<uint32_t> ids = then.id;
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(ids.back(), 500003u);
  const auto last = static_cast<size_t>(std::find(then.id.begin(), then.id.end(), 500003u) - then.id.begin());
  EXPECT_NEAR(then.position[last].x, 0.3f, 1e-3f);
  EXPECT_LT(then.position[last].y, 0.8f) << "it falls";
}

}  // namespace capacity_test
}  // namespace rill::test
