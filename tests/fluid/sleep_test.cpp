// Fluid at rest takes no substeps until something moves it: when it falls asleep, what wakes it and when, and that it ends where it would
// have without sleep.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace sleep_test {

constexpr double kFrame = 1.0 / 60;
constexpr int kLongest = 40 * 60;  // frames within which a tank has to be at rest
constexpr uint32_t kPiece = 42;    // substeps recorded: little more than a frame takes

/// A tank with the solver's defaults, whose fluid may sleep; without particles.
Trial tank(glm::ivec3 room) {
  Trial t = trial();
  t.scene.fluid.spacing = 0.02;
  t.scene.solver = SolverSettings{};
  t.scene.solver.sleep = true;
  setWalls(t, glm::dvec3(room) * t.d());
  t.step = kFrame;
  return t;
}

/// Its lattice is stable, so that it is at rest soon.
Trial stillTank() {
  Trial t = tank({6, 12, 6});
  t.scene.fluid.smoothing_ratio = 2;
  t.x = block({6, 6, 6}, t.d());
  t.scene.gravity_changes = {{1000, {2, -9.81, 0}}};  // bounds follow the strongest gravity: they stay the same with another time
  return t;
}

/// The still tank with a wall of its own at one side.
Trial tankWithSlab() {
  Trial t = stillTank();
  t.scene.solids = {slab({0.1, -0.1, -0.1}, {0.2, 0.3, 0.3})};
  t.x.clear();
  addOutsideSolids(t, block({6, 6, 6}, t.d()));
  return t;
}

class SleepTest : public FluidTest {
 protected:
  static void frames(Run& run, int count) {
    for (int frame = 0; frame < count; ++frame) run.advance(kFrame, kPiece);
  }
  static double timeOf(const Run& run) { return run.progress().time_s; }
  /// Frames until the fluid sleeps.
  static int untilAsleep(Run& run) {
    for (int frame = 1; frame <= kLongest; ++frame) {
      run.advance(kFrame, kPiece);
      if (run.progress().asleep) return frame;
    }
    ADD_FAILURE() << "it does not fall asleep in " << kLongest * kFrame << " s";
    return kLongest;
  }
  /// The state of a trial that sleeps.
  FluidSnapshot asleep(const Trial& trial) {
    auto run = start(trial);
    untilAsleep(*run);
    return run->saved();
  }
  /// That of the still tank.
  const FluidSnapshot& stillTankAsleep() {
    static const FluidSnapshot state = asleep(stillTank());
    return state;
  }
};

double height(const Snapshot& s) {
  double sum = 0;
  for (const glm::dvec3& x : s.x) sum += x.y;
  return sum / double(s.x.size());
}

TEST_F(SleepTest, StillTankFallsAsleepInEveryWayToGather) {
  for (Gather gather : gathersInTurn()) {
    SCOPED_TRACE(nameOf(gather));
    Trial t = stillTank();
    t.gather = gather;
    auto run = start(t);
    untilAsleep(*run);
    const Snapshot before = run->snapshot();
    EXPECT_EQ(before.fastest(), 0);
    const double time = timeOf(*run);
    for (int frame = 0; frame < 3; ++frame) {
      frames(*run, 1);
      EXPECT_EQ(run->progress().substeps, 0u);
    }
    for (const FluidPassRuns& runs : run->fluid().passRuns()) EXPECT_EQ(runs.executed, 0u) << runs.name;
    EXPECT_NEAR(timeOf(*run), time + 3 * kFrame, 1e-6);
    run->advance(kFrame, 0);
    EXPECT_NEAR(timeOf(*run), time + 4 * kFrame, 1e-6) << "a frame without recorded substeps";
    EXPECT_EQ(run->snapshot(), before);
    EXPECT_EQ(run->stats().sleeping, t.x.size());
  }
}

// At h = 2.3 d it melts, and keeps some noise.
TEST_F(SleepTest, MeltedTankFallsAsleep) {
  Trial t = tank({8, 12, 8});
  t.x = block({8, 8, 8}, t.d());
  auto run = start(t);
  EXPECT_LT(untilAsleep(*run), 20 * 60);
}

TEST_F(SleepTest, ChangesNoBitBeforeItSleeps) {
  Trial t = tank({12, 12, 6});
  t.x = block({6, 8, 6}, t.d());
  auto sleeps = start(t);
  t.scene.solver.sleep = false;
  auto never = start(t);
  frames(*sleeps, 20);
  frames(*never, 20);
  EXPECT_EQ(sleeps->snapshot(), never->snapshot());
  EXPECT_EQ(sleeps->stats().sleeping, 0u);
  EXPECT_EQ(never->stats().sleeping, std::nullopt);
  EXPECT_EQ(sleeps->control().executedSubsteps, never->control().executedSubsteps);
  for (const FluidPassRuns& runs : never->fluid().passRuns()) EXPECT_NE(runs.name, "fall asleep");
}

TEST_F(SleepTest, GravityWakesAtItsTimeWithinAFrame) {
  Trial t = stillTank();
  const FluidSnapshot& state = stillTankAsleep();
  auto first = start(t, &state);
  frames(*first, 1);
  t.scene.gravity_changes[0].at = timeOf(*first) + 2.25 * kFrame;
  auto run = start(t, &state);
  frames(*run, 3);
  EXPECT_TRUE(run->progress().asleep);
  run->read({.advance_s = kFrame, .substeps = 0});
  EXPECT_NEAR(run->progress().timeLeft_s, 0.75 * kFrame, 1e-5) << "without recorded substeps it waits at the time of the change";
  EXPECT_FALSE(run->progress().asleep);
  run->read({.resume = true, .substeps = kPiece});
  EXPECT_EQ(run->progress().timeLeft_s, 0);
  EXPECT_GT(run->progress().substeps, 0u);
}

TEST_F(SleepTest, MovingSolidWakesAndLoadsGoOn) {
  Trial t = tankWithSlab();
  t.loads = true;
  t.scene.solids[0].motion = {{900, {0, 0, 0}}, {901, {0.02, 0, 0}}};
  const FluidSnapshot state = asleep(t);
  auto run = start(t, &state);
  frames(*run, 1);
  const SolidLoad load = run->fluid().solidLoads()[0];
  EXPECT_GT(load.force[0], 0);
  frames(*run, 3);
  EXPECT_NEAR(run->fluid().solidLoads()[0].impulse[0] - load.impulse[0], 3 * kFrame * load.force[0], 1e-2 * kFrame * load.force[0])
      << "the fluid still bears on it";
  EXPECT_EQ(run->fluid().solidLoads()[0].force[0], load.force[0]);

  const double begins = timeOf(*run);
  t.scene.solids[0].motion = {{begins, {0, 0, 0}}, {begins + 1, {0.02, 0, 0}}};
  run = start(t, &state);
  frames(*run, 4);
  EXPECT_TRUE(run->progress().asleep);
  frames(*run, 1);
  EXPECT_FALSE(run->progress().asleep);
}

TEST_F(SleepTest, DrivenSolidWakes) {
  Trial t = tankWithSlab();
  t.scene.solids[0].driven = 1;
  const FluidSnapshot state = asleep(t);
  auto run = start(t, &state);
  run->targets = {{0, {0.15, 0.1, 0.1}}};  // where it is
  frames(*run, 1);
  EXPECT_TRUE(run->progress().asleep);
  run->targets = {{0, {0.149, 0.1, 0.1}}};
  frames(*run, 1);
  EXPECT_FALSE(run->progress().asleep);
  EXPECT_GT(run->progress().substeps, 0u);
}

// Bits are the same on each run, and across a checkpoint of a fluid that sleeps.
TEST_F(SleepTest, CheckpointKeepsSleepAndBits) {
  Trial t = stillTank();
  auto whole = start(t);
  untilAsleep(*whole);
  EXPECT_EQ(whole->saved(), stillTankAsleep());
  t.scene.gravity_changes[0].at = timeOf(*whole) + 2.5 * kFrame;
  const FluidSnapshot state = whole->saved();
  whole = start(t, &state);
  frames(*whole, 1);
  const FluidSnapshot later = whole->saved();
  auto resumed = start(t, &later);
  for (int frame = 0; frame < 8; ++frame) {
    frames(*whole, 1);
    resumed->advance(kFrame, 6);
    EXPECT_EQ(whole->progress().asleep, resumed->progress().asleep) << frame;
  }
  EXPECT_FALSE(whole->progress().asleep);
  EXPECT_EQ(whole->snapshot(), resumed->snapshot());
  EXPECT_EQ(whole->saved(), resumed->saved());
}

TEST_F(SleepTest, HostWakesBySnapshot) {
  Trial t = stillTank();
  FluidSnapshot state = stillTankAsleep();
  auto run = start(t, &state);
  frames(*run, 1);
  EXPECT_TRUE(run->progress().asleep);
  setGravity(state, {1, -9.81, 0});
  run = start(t, &state);
  frames(*run, 1);
  EXPECT_FALSE(run->progress().asleep);
  EXPECT_GT(run->progress().substeps, 0u);
}

// Waking is no jolt: the pressure that bears the fluid is still there.
TEST_F(SleepTest, WokenTankStaysWhereItIs) {
  Trial t = stillTank();
  FluidSnapshot state = stillTankAsleep();
  wake(state);
  auto run = start(t, &state);
  const Snapshot before = run->snapshot();
  for (int frame = 0; frame < 15; ++frame) {
    frames(*run, 1);
    EXPECT_LT(run->snapshot().fastest(), 0.01) << frame;
  }
  EXPECT_LT(std::abs(height(run->snapshot()) - height(before)), 1e-3 * t.d());
}

// A slosh stands still where it turns, and other engines' fluid would sleep there.
TEST_F(SleepTest, DamBreakEndsWhereItWouldWithoutSleep) {
  Trial t = tank({16, 12, 4});
  t.x = block({7, 8, 4}, t.d());
  auto sleeps = start(t);
  FluidSnapshot earlier;
  int needed = 0, since = 0;
  for (; needed < kLongest && !sleeps->progress().asleep; ++needed, ++since) {
    if (needed % 100 == 0) earlier = sleeps->saved(), since = 0;
    frames(*sleeps, 1);
  }
  EXPECT_LT(needed, kLongest);
  t.scene.solver.sleep = false;
  auto never = start(t, &earlier);
  frames(*never, since + 4 * 60);
  const Snapshot a = sleeps->snapshot(), b = never->snapshot();
  EXPECT_GT(b.fastest(), 0);
  EXPECT_NEAR(height(a), height(b), 0.1 * t.d());
  // Surfaces, as twice the mean height in each fourth of the tank.
  for (int part = 0; part < 4; ++part) {
    const auto level = [&](const Snapshot& s) {
      double sum = 0, count = 0;
      for (const glm::dvec3& x : s.x)
        if (int(x.x / (4 * t.d())) == part) sum += x.y, ++count;
      return 2 * sum / count;
    };
    EXPECT_NEAR(level(a), level(b), 0.1 * t.d()) << part;
  }
}

}  // namespace sleep_test
}  // namespace rill::test
