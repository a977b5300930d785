// Whole substeps against the reference: the same scene, the same fixed step, particles compared by id. Limits are in spacings; multipliers
// travel as halves on the device, which is a relative error of about 5e-4 of each correction. Of forces: substep_forces_test.cpp; at
// solids: substep_solids_test.cpp.
#include "fluid/substep_limits.hpp"

namespace rill::test {
namespace substep_test {

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
  const Trial t = agitated(0.2, 0.2);
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

}  // namespace substep_test
}  // namespace rill::test
