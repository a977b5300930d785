// Substeps at solids against the reference: fluid that rests and flows on them, friction, motion.
#include "fluid/substep_limits.hpp"

namespace rill::test {
namespace substep_test {

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
  t.v.assign(t.x.size(), {0.7, -1.4, 0.35});
  expectEqual(t, 1, kOne, kOne);
  expectEqual(t, 10, kTen, kTen);
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
