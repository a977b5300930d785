// Whole substeps against the reference: the same scene, the same fixed step, particles compared by id. Limits are in spacings; multipliers
// travel as halves on the device, which is a relative error of about 5e-4 of each correction.
#include "fluid/rig.hpp"

namespace rill::test {
namespace substep_test {

using SubstepTest = FluidTest;

constexpr double kOne = 2e-4;  // after one substep
constexpr double kTen = 1e-3;  // after ten
constexpr double kAgeing = 0.1;

TEST_F(SubstepTest, CloudMatchesReference) {
  Trial t = trial();
  t.x = randomCloud(400, 7.4 * t.d(), 11);
  t.v = randomCloud(400, 1.0, 12, glm::dvec3(-0.5));
  expectEqual(t, 1, kOne, kOne);
}

TEST_F(SubstepTest, LatticeMatchesReference) {
  Trial t = trial();
  t.x = block({7, 6, 8}, t.d());
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, CompressedLatticeMatchesReference) {
  Trial t = trial();
  t.x = block({7, 6, 8}, 0.93 * t.d(), {}, 0.05);
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, JitteredBlockInACornerMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.2);
  t.v = randomCloud(t.x.size(), 0.4, 5, glm::dvec3(-0.2));
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, BlockInTheFarCornerMatchesReference) {
  Trial t = trial();
  setWalls(t, {0.75, 1, 0.875});
  t.x = block({6, 7, 6}, t.d(), {0.75 - 6 * t.d(), 1 - 7 * t.d(), 0.875 - 6 * t.d()}, 0.1);
  t.scene.gravity[0] = 3;
  t.scene.gravity[1] = 9.81;
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, ThinSlabMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 2.2 * t.d()});
  t.x = block({8, 8, 2}, t.d(), {0.1, 0, 0.1 * t.d()}, 0.05);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, LayerOfOneSpacingMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 1.0 * t.d()});
  t.x = block({10, 8, 1}, t.d(), {}, 0.05);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, OpenSidesMatchReference) {
  Trial t = trial();
  setWalls(t, {0.5, 1, 0.5}, 0b001010);
  t.x = block({8, 6, 8}, t.d(), {}, 0.1);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

// The wrapped grid: rows that are cut where it begins anew, on either side of the origin and many grids away from it.
TEST_F(SubstepTest, WrappedGridMatchesReference) {
  Trial t = trial();
  for (const glm::dvec3 from : {glm::dvec3(-3.3 * t.d()), glm::dvec3(11.3, -7.1, 4.6), glm::dvec3(-9.7, 0.4, -13.2)}) {
    t.x = block({7, 6, 8}, 0.95 * t.d(), from, 0.05);
    expectEqual(t, 1, kOne, kOne);
  }
}

TEST_F(SubstepTest, Poly6SpikyMatchesReference) {
  Trial t = trial();
  t.scene.solver.kernel = KernelChoice::Poly6Spiky;
  t.scene.solver.relaxation = 0.6;  // of what is stable with this kernel
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, WideSupportMatchesReference) {
  Trial t = trial();
  t.scene.fluid.smoothing_ratio = 3;
  t.scene.solver.relaxation = 0.25;  // of what is stable with this support
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, OneStepOfViscosityMatchesReference) {
  Trial t = trial();
  t.scene.fluid.viscosity = 20;
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

// Gains and damping between those of a fluid at rest and of one that is rough.
Trial calmed() {
  Trial t = trial();
  t.scene.solver.relaxation.reset();
  t.scene.solver.warm_start.reset();
  t.scene.solver.artificial_viscosity = 0.3;
  t.stepwise = true;
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 0.6, 5, glm::dvec3(-0.3));
  return t;
}

TEST_F(SubstepTest, NoiseDampingMatchesReference) {
  expectEqual(calmed(), 1, kOne, kOne);
  expectEqual(calmed(), 10, kTen, kTen, kAgeing);
}

// A block that is squeezed: what a correction closes goes on in the next, but not in the first substep of a block.
TEST_F(SubstepTest, MomentumMatchesReference) {
  Trial t = trial();
  t.stepwise = false;
  t.scene.gravity[1] = 0;
  t.x = block({7, 6, 8}, t.d(), {0.2, 0.2, 0.2}, 0.02);
  for (const glm::dvec3& x : t.x) t.v.push_back(-6.0 * (x - 0.2 - glm::dvec3(3.5, 3, 4) * t.d()));
  expectEqual(t, 6, kTen, kTen);
  Oracle without(t);
  EXPECT_GT(without.solver().settings.momentum, 0);
  without.solver().settings.momentum = 0;
  without.advance(6);
  EXPECT_GT(difference(t, 6, without).velocity, 5 * kTen);
  t.scene.solver.iterations = 2;
  EXPECT_EQ(Oracle(t).solver().settings.momentum, 0);
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

TEST_F(SubstepTest, NoiseDampingNeedsGravity) {
  Trial t = calmed();
  t.scene.gravity[1] = 0;
  t.x = block({6, 7, 6}, t.d());
  expectEqual(t, 1, kOne, kOne);
  const FluidStats stats = start(t)->stats();
  EXPECT_EQ(stats.artificialViscosity_Pa_s, 0);
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

TEST_F(SubstepTest, SeveralStepsOfViscosityMatchReference) {
  Trial t = trial();
  t.scene.fluid.viscosity = 2500;
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
  const ParticleSet particles = t.particles();
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, VorticityMatchesReference) {
  Trial t = trial();
  t.scene.fluid.vorticity = 0.5;
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
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
  Trial t = trial();
  t.scene.fluid.drag = 30;
  setWalls(t, {1, 1, 1});
  t.scene.solids = {ball({0.5, 0.6, 0.5}, 0.1)};
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
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

TEST_F(SubstepTest, TensileMatchesReference) {
  Trial t = trial();
  t.scene.fluid.tensile = 1;
  t.step = 4e-3;
  t.stepwise = true;
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.2);
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, ThreeIterationsMatchReference) {
  Trial t = trial();
  t.scene.solver.iterations = 3;
  t.scene.fluid.tensile = 0.5;
  t.stepwise = true;
  t.x = block({6, 7, 6}, t.d(), {}, 0.15);
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
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

TEST_F(SubstepTest, ThreeIterationsAtWallsMatchReference) {
  Trial t = trial();
  t.scene.solver.iterations = 3;
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.15);
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen, kAgeing);
}

TEST_F(SubstepTest, ChangingGravityMatchesReference) {
  Trial t = trial();
  t.scene.gravity_changes = {{0.003, {5, 0, 0}}, {0.0062, {0, 0, -20}}};
  t.x = block({5, 5, 5}, t.d());
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, RestOnABoxMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solids = {slab({0.1, 0, 0.1}, {0.9, 0.25, 0.9})};
  t.x = block({7, 4, 7}, t.d(), {0.2, 0.25, 0.25}, 0.05);
  t.v = randomCloud(t.x.size(), 1.0, 5, {-0.5, -1.0, 0.5});
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, RestOnATurnedBoxMatchesReference) {
  Trial t = trial();
  t.scene.solids = {slab({-0.4, -0.2, -0.4}, {0.4, 0.2, 0.4})};
  t.scene.solids[0].rotation[2] = 0.6;
  t.scene.solids[0].rotation[3] = 0.8;
  t.x = block({6, 4, 6}, t.d(), {-0.5, 0.46, -0.2}, 0.05);
  t.v = randomCloud(t.x.size(), 1.0, 5, {-0.5, -4.0, 0.5});
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, FlowOverABallMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solids = {ball({0.5, 0.2, 0.5}, 0.2)};
  t.x = block({7, 4, 7}, t.d(), {0.25, 0.405, 0.25}, 0.05);
  t.v.assign(t.x.size(), {0.5, -3, 0});
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

// A wall, a ball and a turned box at once, with a support so wide that what is beside a particle meets its bound.
TEST_F(SubstepTest, WideSupportBetweenSolidsInTwoIterationsMatchesReference) {
  Trial t = trial();
  t.scene.fluid.smoothing_ratio = 3;
  t.scene.solver.relaxation = 0.25;
  t.scene.solver.iterations = 2;
  setWalls(t, {1, 1, 0.25 + 7 * t.d()});
  t.scene.solids = {ball({0.5, 0.2, 0.5}, 0.2), slab({0.75, 0.35, 0.2}, {0.95, 0.6, 0.8})};
  t.scene.solids[1].rotation[2] = 0.6;
  t.scene.solids[1].rotation[3] = 0.8;
  t.x = block({7, 4, 7}, t.d(), {0.25, 0.405, 0.25}, 0.05);
  t.v.assign(t.x.size(), {0.5, -3, 0});
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, FrictionAndRestitutionMatchReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solids = {slab({0.1, 0, 0.1}, {0.9, 0.25, 0.9})};
  t.scene.solids[0].friction = 0.4;
  t.scene.solids[0].restitution = 0.5;
  t.x = block({7, 4, 7}, t.d(), {0.2, 0.26, 0.25}, 0.05);
  t.v.assign(t.x.size(), {1, -2, 0.5});
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, 1.5 * kTen, kTen);
}

TEST_F(SubstepTest, FrictionOnALoneParticleMatchesReference) {
  Trial t = trial();
  t.scene.solids = {slab({-1, -1, -1}, {1, 0, 1})};
  t.scene.solids[0].friction = 0.3;
  t.x = {{0, 0.5 * t.d(), 0}};
  t.v = {{0.5, 0, 0}};
  expectEqual(t, 10, 1e-5, 1e-5);
}

TEST_F(SubstepTest, MovingSolidMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solids = {slab({0.1, 0, 0.1}, {0.9, 0.25, 0.9}), ball({0.5, 0.8, 0.5}, 0.15)};
  t.scene.solids[0].motion = {{0, {0, 0, 0}}, {0.1, {0, 0.1, 0}}, {1, {0.1, 0, 0}}};
  t.scene.solids[0].friction = 0.2;
  t.scene.solids[1].motion = {{0.004, {0, 0, 0}}, {0.104, {0, -0.2, 0}}};
  t.x = block({7, 4, 7}, t.d(), {0.2, 0.26, 0.25}, 0.05);
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
}

TEST_F(SubstepTest, SolidWithViscosityMatchesReference) {
  Trial t = trial();
  t.scene.fluid.viscosity = 20;
  setWalls(t, {1, 1, 1});
  t.scene.solids = {slab({0.1, 0, 0.1}, {0.9, 0.25, 0.9})};
  t.x = block({7, 4, 7}, t.d(), {0.2, 0.25, 0.25}, 0.05);
  t.v.assign(t.x.size(), {1, -1, 0.5});
  expectEqual(t, 10, kTen, kTen);
}

}  // namespace substep_test
}  // namespace rill::test
