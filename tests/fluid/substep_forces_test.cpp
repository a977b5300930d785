// Substeps with viscosity, noise damping, vorticity and drag against the reference.
#include <cmath>
#include <numbers>

#include "fluid/substep_limits.hpp"

namespace rill::test {
namespace substep_test {

TEST_F(SubstepTest, OneStepOfViscosityMatchesReference) {
  Trial t = agitated(1.0);
  t.scene.fluid.viscosity = 20;
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, SeveralStepsOfViscosityMatchReference) {
  Trial t = agitated(1.0);
  t.scene.fluid.viscosity = 2500;
  const ParticleSet particles = t.particles();
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

// Gains and damping between those of a fluid at rest and of one that is rough.
Trial calmed() {
  Trial t = agitated(0.3);
  t.scene.solver.relaxation.reset();
  t.scene.solver.warm_start.reset();
  t.scene.solver.artificial_viscosity = 0.3;
  t.stepwise = true;
  return t;
}

TEST_F(SubstepTest, NoiseDampingMatchesReference) {
  expectEqual(calmed(), 1, kOne, kOne);
  expectEqual(calmed(), 10, kTen, kTen, kAgeing);
}

// The pass runs in the first substep of a block alone, with the time since the last one.
TEST_F(SubstepTest, NoiseDampingOnceABlockMatchesReference) {
  Trial t = calmed();
  t.stepwise = false;
  expectEqual(t, 8, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, NoiseDampingInThreeIterationsMatchesReference) {
  Trial t = calmed();
  t.scene.solver.iterations = 3;
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, NoiseDampingUnderABallMatchesReference) {
  Trial t = calmed();
  t.scene.solids.push_back(ball({0.2, 0.545, 0.2}, 0.1));
  t.scene.solids.back().friction = 0.3;
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

// Deep fluid that flows slowly: what its neighbors have in common tells how much of its own pressure a particle feels.
TEST_F(SubstepTest, SlowFlowMatchesReference) {
  constexpr glm::ivec3 kTank = {6, 14, 6};
  Trial t = trial();
  setWalls(t, t.d() * glm::dvec3(6, 20, 6));
  t.x = block(kTank, t.d(), {}, 0.05);
  for (const glm::dvec3& x : t.x) t.v.emplace_back(0, 0, 0.05 * std::cos(std::numbers::pi * x.y / (kTank.y * t.d())));
  t.scene.solver.relaxation.reset();
  t.scene.solver.artificial_viscosity = 0.3;
  expectEqual(t, 30, kTen, kTen);
}

TEST_F(SubstepTest, NoiseDampingNeedsGravity) {
  Trial t = calmed();
  t.scene.gravity[1] = 0;
  t.x = block({6, 7, 6}, t.d());
  expectEqual(t, 1, kOne, kOne);
  const FluidStats stats = start(t)->stats();
  EXPECT_EQ(stats.artificialViscosity_Pa_s, 0);
}

// The eighth substep would rebuild the list, and so begin a block on the device.
TEST_F(SubstepTest, TensileBesideNoiseDampingMatchesReference) {
  for (const double power : {15.0, 4.5}) {
    Trial t = calmed();
    t.scene.fluid.tensile = 1;
    t.scene.fluid.tensile_power = power;
    t.stepwise = false;
    t.scene.fluid.tensile_radius = 0.3;
    t.x = block({6, 7, 6}, t.d(), {}, 0.2);
    expectEqual(t, 7, kTen, kTen, kAgeing);
  }
}

TEST_F(SubstepTest, ArtificialViscosityDampsNoise) {
  Trial none = calmed(), little = calmed();
  none.scene.solver.artificial_viscosity = 0;
  little.scene.solver.artificial_viscosity = 0.03;
  double said = 0;
  const auto energy = [&](Trial t) {
    t.x = block({6, 7, 6}, t.d());  // a jittered one springs apart, which is more than its noise
    auto run = start(t);
    for (int n = 0; n < 30; ++n) run->substeps(1);
    const FluidStats stats = run->stats();
    said = stats.artificialViscosity_Pa_s;
    return stats.kinetic_J;
  };
  const double full = energy(calmed()), saidFull = said, some = energy(little), nothing = energy(none);
  EXPECT_LT(some, 0.99 * nothing);
  EXPECT_LT(full, 0.9 * some);
  EXPECT_EQ(said, 0);
  const double atRest = 0.3 * 1000 * calmed().d() * std::sqrt(9.81 * calmed().d());
  EXPECT_LE(saidFull, 1.000001 * atRest);
  EXPECT_GT(saidFull, 0.5 * atRest);
}

TEST_F(SubstepTest, VorticityMatchesReference) {
  Trial t = agitated(1.0);
  t.scene.fluid.vorticity = 0.5;
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, ViscosityAndVorticityMatchReference) {
  Trial t = trial();
  t.scene.fluid.viscosity = 20;
  t.scene.fluid.vorticity = 0.5;
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, DragMatchesReference) {
  Trial t = agitated(1.0);
  t.scene.fluid.drag = 30;
  t.scene.solids = {ball({0.5, 0.6, 0.5}, 0.1)};
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, DragReachesTerminalVelocity) {
  Trial t = trial();
  t.x = {{0, 0, 0}};
  t.scene.fluid.drag = 20;
  auto run = start(t);
  run->advance(0.5, 64);
  EXPECT_NEAR(run->snapshot().v[0].y, -9.81 / 20, 0.02 * 9.81 / 20) << "g over drag";
}

}  // namespace substep_test
}  // namespace rill::test
