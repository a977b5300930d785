// The pressure that holds the fluid's weight is there when time begins: no wave is released, and nothing else changes.
#include <glm/geometric.hpp>
#include <limits>

#include "fluid/rig.hpp"
#include "shape/records.hpp"

namespace rill::test {
namespace initial_pressure_test {

constexpr double kGravity = 9.81;

// A column that fills its tank from side to side, at rest; it fits, so that settling finds nothing to do.
Trial column(int layers) {
  Trial t = trial();
  t.settle = true;
  t.scene.solver.relaxation.reset();
  t.scene.solver.warm_start.reset();
  setWalls(t, {6 * t.d(), 1.5 * layers * t.d(), 6 * t.d()});
  t.x = block({6, layers, 6}, t.d());
  t.step = 5e-4;
  return t;
}

// The same with a free side.
Trial dam(int layers) {
  Trial t = column(layers);
  setWalls(t, {20 * t.d(), 1.5 * layers * t.d(), 6 * t.d()});
  return t;
}

struct InitialPressureTest : FluidTest {
  /// By id, Pa.
  std::vector<double> pressures(Run& run, const Trial& t) {
    const FluidSnapshot saved = run.saved();
    const double step = run.control().warmStep;
    std::vector<double> p(saved.warmStart.size());
    for (size_t i = 0; i < p.size(); ++i) p[saved.id[i]] = -t.scene.fluid.density * double{saved.warmStart[i]} / (step * step);
    return p;
  }
};

// In the middle of the tank, at its walls and in its edges. Means of two layers: neighboring layers alternate.
TEST_F(InitialPressureTest, EqualsTheWeightAbove) {
  const Trial t = column(30);
  auto run = start(t);
  run->substeps(1);
  const auto p = pressures(*run, t);
  const SmoothingKernel kernel(KernelChoice::Wendland, t.scene.fluid.smoothing_ratio * t.d(), t.d());
  // Force of a unit pressure gradient on the cubic lattice: the gradient that balances the weight is larger by its inverse.
  double force = 0;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) force -= kernel.gradientOverR(t.d() * std::sqrt(double(x * x + y * y + z * z))) * y * y * t.d() * t.d();
  double low[6][6] = {}, high[6][6] = {};
  for (size_t i = 0; i < p.size(); ++i) {
    const auto at = [&](int a) { return static_cast<int>(t.x[i][a] / t.d()); };
    if (at(1) == 4 || at(1) == 5) low[at(0)][at(2)] += p[i] / 2;
    if (at(1) == 18 || at(1) == 19) high[at(0)][at(2)] += p[i] / 2;
  }
  for (int x = 0; x < 6; ++x)
    for (int z = 0; z < 6; ++z) {
      const double rises = (low[x][z] - high[x][z]) / (14 * t.d()) / (t.scene.fluid.density * kGravity);
      EXPECT_NEAR(rises * force, 1, 0.025) /* 0.020 at one wall */ << "column " << x << ", " << z << ": meters of water a meter";
    }
}

TEST_F(InitialPressureTest, SupportsAColumnFromTheFirstSubstep) {
  Trial t = column(30);
  const auto fall = [&](bool settle) {
    t.settle = settle;
    auto run = start(t);
    run->substeps(4);
    const Snapshot after = run->snapshot();
    return -after.velocitySum().y / static_cast<double>(after.v.size()) / (4 * t.step * kGravity);
  };
  EXPECT_NEAR(fall(true), 0, 0.1) << "of a free fall, in the mean";
  EXPECT_GT(fall(false), 0.5) << "without it the column falls, until a wave from the floor has come up to it";
}

TEST_F(InitialPressureTest, MatchesReference) {
  for (Gather gather : kGathers) {
    Trial t = dam(12);
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t);
    run->substeps(1);
    const auto device = pressures(*run, t);
    Oracle oracle(t);
    oracle.advance(1);
    const double whole = t.scene.fluid.density * kGravity * 12 * t.d();
    for (size_t i = 0; i < device.size(); ++i) {
      const double exact = -t.scene.fluid.density * oracle.solver().state.warm[i] / (t.step * t.step);
      ASSERT_NEAR(device[i], exact, 0.005 * whole) << "particle " << i;
    }
  }
}

TEST_F(InitialPressureTest, FollowingFlowMatchesReference) { expectEqual(dam(12), 20, 2e-4, 1e-4); }

// Were the fall's speed part of what the pressure has to hold up, the whole column would be stopped before it has begun to move.
TEST_F(InitialPressureTest, KeepsMovingParticlesMoving) {
  Trial t = column(12);
  t.v.assign(t.x.size(), glm::dvec3(0, -2, 0));
  auto run = start(t);
  run->substeps(1);
  const Snapshot after = run->snapshot();
  for (size_t i = 0; i < t.x.size(); ++i) {
    if (t.x[i].y > 6 * t.d()) { ASSERT_NEAR(after.v[i].y, -2, 0.01) << "m/s, far above the impact"; }
  }
}

TEST_F(InitialPressureTest, MovingFlowMatchesReference) {
  Trial t = dam(8);
  t.v.assign(t.x.size(), glm::dvec3(1, -0.5, 0));
  expectEqual(t, 10, 2e-4, 1e-4);
}

TEST_F(InitialPressureTest, SupportsTheColumnForAllIterationsAndGains) {
  for (const uint32_t iterations : {1u, 2u, 4u, 8u})
    for (const double gain : {0.001, 0.02}) {
      SCOPED_TRACE(std::to_string(iterations) + " iterations, gain " + std::to_string(gain));
      Trial t = column(30);
      t.scene.solver.iterations = iterations;
      t.scene.solver.warm_start = gain;
      auto run = start(t);
      const double before = -run->stats().potential_J;
      run->advance(1.0 / 60);
      EXPECT_LT(run->snapshot().fastest(), 0.1) << "m/s";
      const FluidStats after = run->stats();
      EXPECT_LT(after.kinetic_J + after.potential_J, -before * 1.001);
    }
}

TEST_F(InitialPressureTest, HandlesSolidsAndNonFiniteParticles) {
  Trial t = column(12);
  t.scene.solids.push_back(slab({0, 0, 0}, {6 * t.d(), 2 * t.d(), 6 * t.d()}));
  t.x = block({6, 10, 6}, t.d(), {0, 2 * t.d(), 0});
  t.scene.fluid.viscosity = 1;
  expectEqual(t, 10, 2e-4, 1e-4);
  t.x[7].x = std::numeric_limits<double>::quiet_NaN();
  auto run = start(t);
  run->advance(0.01);
  EXPECT_TRUE(run->snapshot().finite());
  EXPECT_LT(run->snapshot().fastest(), 0.5) << "m/s: a hole is left where it was";
}

// What moves waits until time begins.
TEST_F(InitialPressureTest, SolidsDoNotMove) {
  Trial t = column(8);
  Solid lid = slab({-1, 9 * t.d(), -1}, {1, 10 * t.d(), 1});
  lid.motion = {{0, {0, 0, 0}}, {1, {0, -t.d(), 0}}};
  t.scene.solids.push_back(lid);
  auto run = start(t);
  run->read({.advance_s = t.step, .substeps = 12});
  ASSERT_EQ(run->control().nextPhase, kPhaseInitialPressure);
  const FluidSnapshot saved = run->saved();
  ASSERT_EQ(saved.solids.size(), kPoseNumbers);
  EXPECT_NEAR(saved.solids[1], 9.5 * t.d(), 1e-6);
}

TEST_F(InitialPressureTest, TakesNoTime) {
  auto run = start(column(8));
  run->substeps(2);
  EXPECT_EQ(run->progress().substeps, 2u);
  EXPECT_NEAR(run->progress().time_s, 1e-3, 1e-9);
  EXPECT_EQ(run->progress().timeDropped_s, 0);
}

// A host records a few substeps a frame, whatever is due: the same pressure, later.
TEST_F(InitialPressureTest, ConvergesOverSeveralAdvances) {
  const Trial t = column(12);
  auto whole = start(t), parts = start(t);
  whole->substeps(1);
  for (int n = 0; n < 40 && parts->progress().time_s == 0; ++n) parts->read({.advance_s = t.step, .substeps = 12});
  EXPECT_GT(parts->progress().time_s, 0);
  EXPECT_EQ(parts->saved().warmStart, whole->saved().warmStart);
}

TEST_F(InitialPressureTest, ContinuesFromACheckpoint) {
  const Trial t = column(12);
  auto run = start(t);
  const FluidStep frame{.advance_s = 4 * t.step, .substeps = 12};
  run->read(frame);
  EXPECT_EQ(run->control().nextPhase, kPhaseInitialPressure) << "12 are not enough";
  EXPECT_GT(run->progress().timeLeft_s, 0);
  run->read({.advance_s = 0, .substeps = 12});  // gives the advance up
  const FluidSnapshot saved = run->saved();
  auto resumed = start(t, &saved);
  for (int n = 0; n < 8; ++n) EXPECT_EQ(run->read(frame), resumed->read(frame)) << n;
  EXPECT_EQ(run->control().nextPhase, kPhaseAdvancing);
  EXPECT_GT(run->progress().time_s, 0);
  EXPECT_LT(run->snapshot().fastest(), 0.5 * kGravity * run->progress().time_s) << "and it holds";
}

TEST_F(InitialPressureTest, IsSkippedWithoutNeed) {
  const auto most = [&](const Trial& t) {
    const auto run = start(t);
    return run->fluid().substepsToComplete() / run->fluid().substepsPerBlock() - t.scene.solver.max_substeps;
  };
  const Trial bears = column(8);
  EXPECT_GT(most(bears), kSettleSubsteps);
  Trial falls = bears;
  falls.scene.domain.reset();
  EXPECT_EQ(most(falls), kSettleSubsteps) << "nothing holds it up";
  Trial floats = bears;
  floats.scene.gravity[1] = 0;
  EXPECT_EQ(most(floats), kSettleSubsteps) << "nothing pulls it down";
  Trial forgets = bears;
  forgets.scene.solver.warm_start = 0;
  EXPECT_EQ(most(forgets), kSettleSubsteps) << "no pressure is carried from substep to substep";
}

TEST_F(InitialPressureTest, IterationsAreBoundedInDeepWater) {
  Trial t = column(8);
  t.x.push_back({3 * t.d(), 5000 * t.d(), 3 * t.d()});
  t.scene.domain->max[1] = 6000 * t.d();
  const auto run = start(t);
  EXPECT_LE(run->fluid().substepsToComplete(),
            run->fluid().substepsPerBlock() * (t.scene.solver.max_substeps + kSettleSubsteps + kMaxInitialPressureIterations));
}

}  // namespace initial_pressure_test
}  // namespace rill::test
