// How long substeps are, and what an advance makes of the time that it is asked for.
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"

namespace rill::test {
namespace step_control_test {

// A column in a corner of a tank, with the solver's own choice of steps.
Trial dam(glm::ivec3 count, glm::dvec3 tank) {
  Trial t = trial();
  setWalls(t, tank);
  t.x = block(count, t.d());
  t.step = 1.0 / 60;
  t.scene.solver.cfl = 0.25;
  t.scene.solver.tolerance = 0.005;
  return t;
}

class StepControlTest : public FluidTest {
 protected:
  // Goes on to the end of an advance, a block of substeps a graph, and hands over what came back after each.
  template <class See>
  void follow(Run& run, double seconds, See&& see) {
    bool resume = false;
    do {
      const Snapshot s = run.read({.advance_s = seconds, .resume = resume, .substeps = 6});
      if (HasFatalFailure()) return;
      see(s);
      resume = true;
    } while (run.progress().timeLeft_s > 0);
  }
};

// A planned step may be a quarter longer than cfl's bound where that saves a sliver at the end of an advance, and correction may double the
// way.
TEST_F(StepControlTest, RespectsCfl) {
  Trial t = dam({6, 8, 5}, {1, 1, 5.0 / 16});
  t.scene.solver.tolerance = 0;
  auto run = start(t);
  const double reach = t.scene.solver.cfl * t.d();
  std::vector<glm::dvec3> before = t.x;
  uint32_t substeps = 0;
  for (int frame = 0; frame < 12; ++frame) {
    substeps = 0;
    follow(*run, 1.0 / 60, [&](const Snapshot& s) {
      const FluidControl& c = run->control();
      EXPECT_LE(c.speed * c.nextStep, 1.2501 * reach);
      const double ways = 2 * reach * (c.substeps - substeps);
      for (size_t i = 0; i < s.x.size(); ++i) EXPECT_LE(glm::length(s.x[i] - before[i]), ways * 1.0001) << i;
      before = s.x;
      substeps = c.substeps;
    });
  }
  EXPECT_GT(substeps, 1u);
  // Not much shorter than it allows, either: the fastest particle sets the pace.
  EXPECT_LT(substeps, 4 * run->snapshot().fastest() / 60 / reach);
}

// One particle in free flight takes steps of just its bound.
TEST_F(StepControlTest, TakesTheLongestStepInFreeFlight) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.step = 1.0 / 60;
  t.scene.solver.cfl = 0.25;
  t.x = {{0, 0, 0}};
  t.v = {{6, 0, 0}};
  auto run = start(t);
  run->advance(1.0 / 60);
  EXPECT_EQ(run->progress().substeps, std::ceil(6.0 / 60 / (0.25 * t.d()) - 0.25));
  EXPECT_NEAR(run->snapshot().x[0].x, 0.1, 1e-6);
}

TEST_F(StepControlTest, MeetsTheTolerance) {
  Trial t = dam({6, 6, 6}, glm::dvec3(6.0 / 16, 1, 6.0 / 16));
  std::vector<uint32_t> steps;
  for (double tolerance : {0.002, 0.01}) {
    SCOPED_TRACE(tolerance);
    t.scene.solver.tolerance = tolerance;
    auto run = start(t);
    for (int frame = 0; frame < 60; ++frame) run->advance(1.0 / 60, 12);
    const FluidStats stats = run->stats();
    EXPECT_LE(stats.densityErrorMean, tolerance);
    EXPECT_LT(std::abs(stats.densitySignedMedian), 5 * tolerance);
    EXPECT_EQ(stats.timeDropped_s, 0);
    steps.push_back(stats.substeps);
  }
  EXPECT_GE(steps[0], steps[1]) << "a finer tolerance takes no fewer substeps";
}

TEST_F(StepControlTest, DropsTimeBeyondMaxSubsteps) {
  Trial t = trial();
  t.step = 0.001;
  t.scene.solver.max_substeps = 7;
  t.x = block({3, 3, 3}, t.d());
  auto run = start(t);
  double time = 0;
  for (int frame = 0; frame < 3; ++frame) {
    run->advance(0.0105);
    const FluidProgress p = run->progress();
    EXPECT_EQ(p.substeps, 7u);
    EXPECT_EQ(p.timeLeft_s, 0);
    EXPECT_GT(p.timeDropped_s, 0.002);
    EXPECT_NEAR(p.time_s - time + p.timeDropped_s, 0.0105, 1e-7);
    time = p.time_s;
  }
  // Nothing is dropped where the steps fit.
  run->advance(0.006);
  EXPECT_EQ(run->progress().timeDropped_s, 0);
  EXPECT_NEAR(run->progress().time_s - time, 0.006, 1e-7);
}

// What was not recorded to its end is dropped by the next advance, and said so.
TEST_F(StepControlTest, DropsAbandonedAdvance) {
  Trial t = trial();
  t.x = block({3, 3, 3}, t.d());
  auto run = start(t);
  run->read({.advance_s = 0.01, .substeps = 6});
  EXPECT_NEAR(run->progress().timeLeft_s, 0.004, 1e-7);
  run->read({.advance_s = 0.005, .substeps = 6});
  EXPECT_NEAR(run->progress().time_s, 0.011, 1e-7);
  EXPECT_EQ(run->progress().timeLeft_s, 0);
  EXPECT_NEAR(run->progress().timeDropped_s, 0.004, 1e-7);
}

// To a few roundings of each substep's float.
TEST_F(StepControlTest, AdvancesByTheGivenTime) {
  Trial t = dam({4, 5, 4}, {0.5, 0.75, 0.25});
  auto run = start(t);
  double time = 0;
  for (double frame : {1.0 / 60, 1.0 / 24, 0.0123, 1e-3, 1.0 / 144, 1e-5, 1.0 / 30, 3.3e-4, 1.0 / 60}) {
    run->advance(frame);
    time += frame;
    EXPECT_NEAR(run->progress().time_s, time, 2e-8 * run->progress().substeps + 1e-8) << frame;
    EXPECT_EQ(run->progress().timeDropped_s, 0);
    EXPECT_GT(run->progress().substeps, 0u);
    time = run->progress().time_s;
  }
}

// Many short steps at a late time: float alone would have lost them.
TEST_F(StepControlTest, KeepsTimeInLongRuns) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.step = 100;
  t.x = {{0, 0, 0}};
  auto run = start(t);
  run->advance(10000);
  const double late = run->progress().time_s;
  EXPECT_NEAR(late, 10000, 1e-3) << "a device's division is good to 2.5 ulp";
  for (int n = 0; n < 40; ++n) run->advance(1e-4, 6);
  EXPECT_NEAR(run->progress().time_s, late + 40e-4, 1e-6);
}

// The preview's setting: four iterations, long steps, no tolerance.
TEST_F(StepControlTest, PreviewStaysBounded) {
  for (double cfl : {0.25, 10.0}) {
    SCOPED_TRACE(cfl);
    Trial t = dam({6, 7, 5}, {0.75, 0.75, 5.0 / 16});
    t.scene.solver.iterations = 4;
    t.scene.solver.tolerance = 0;
    t.scene.solver.cfl = cfl;
    t.step = 0.01;
    auto run = start(t);
    const FluidStats first = run->stats();
    const double energy = first.potential_J;
    for (int frame = 0; frame < (cfl > 1 ? 60 : 30); ++frame) {
      run->advance(1.0 / 60, 12);
      if (frame % 10 != 9) continue;
      const FluidStats stats = run->stats();
      ASSERT_TRUE(run->measured().finite());
      EXPECT_EQ(stats.outside, 0u);
      EXPECT_LT(stats.kinetic_J + stats.potential_J, 1.05 * energy) << frame;
      EXPECT_LT(stats.densityErrorMean, 0.01) << frame;
    }
  }
}

TEST_F(StepControlTest, GravityFollowsItsSchedule) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.step = 1.0 / 512;
  t.scene.gravity_changes = {{0.0, {1, 0, 0}}, {0.125, {0, -4, 0}}, {0.25, {0, 0, 8}}, {10, {100, 0, 0}}};
  t.x = {{0, 0, 0}};
  auto run = start(t);
  run->advance(0.5);
  EXPECT_LT(glm::length(run->snapshot().v[0] - glm::dvec3(0.125, -0.5, 2)), 1e-6);
  const FluidStats stats = run->stats();
  EXPECT_NEAR(stats.potential_J, -t.scene.fluid.density * std::pow(t.d(), 3) * 8 * run->measured().x[0].z, 1e-5);
}

// With steps of its own choice: each change is late by less than a step.
TEST_F(StepControlTest, GravityTurnsWithinAStep) {
  Trial t = trial();
  t.scene.gravity[1] = -8;
  t.scene.gravity_changes = {{0.1, {0, 8, 0}}};
  t.step = 1.0 / 60;
  t.scene.solver.cfl = 0.25;
  t.x = {{0, 0, 0}};
  auto run = start(t);
  for (int frame = 0; frame < 12; ++frame) run->advance(1.0 / 60, 6);
  EXPECT_NEAR(run->snapshot().v[0].y, 0, 2 * 8.0 / 60);
  EXPECT_LE(run->snapshot().v[0].y, 1e-4);
}

// A piston across the whole tank drives the water before it; no particle is left inside it or behind it.
TEST_F(StepControlTest, PistonPushesWithoutPenetration) {
  Trial t = dam({7, 6, 4}, {1, 0.75, 0.25});
  const double face = 0.125;
  for (glm::dvec3& x : t.x) x.x += face;
  Solid piston = slab({0.0625, 0, 0}, {face, 0.75, 0.25});
  piston.motion = {{0, {0, 0, 0}}, {0.25, {0.25, 0, 0}}, {0.4, {0.25, 0, 0}}};
  t.scene.solids = {piston};
  auto run = start(t);
  double center = 0;
  for (int frame = 1; frame <= 20; ++frame) {
    run->advance(1.0 / 60, 12);
    const Snapshot s = run->snapshot();
    ASSERT_TRUE(s.finite());
    const double time = run->progress().time_s, at = face + std::min(time, 0.25);
    center = 0;
    for (size_t i = 0; i < s.x.size(); ++i) {
      EXPECT_GE(s.x[i].x, at + 0.5 * t.d() - 1e-3 * t.d()) << i << " at " << time;
      center += s.x[i].x / double(s.x.size());
    }
  }
  EXPECT_GT(center, face + 0.25 + 2 * t.d());
}

}  // namespace step_control_test
}  // namespace rill::test
