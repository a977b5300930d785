// Particles that overlap at the start part before time begins, and gain no speed by it.
#include <glm/geometric.hpp>

#include "fluid/bodies_fixture.hpp"

namespace rill::test {
namespace settling_test {

using SettlingTest = bodies_test::BodiesTest;

// A lattice as wide as its box and 0.16 spacings too high for it: the last layer is pressed into the one below.
Trial tight() {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.solver.cfl = 0.25;
  setWalls(t, {8 * t.d(), 7.84 * t.d(), 16 * t.d()});
  t.x = block({8, 8, 8}, t.d());
  t.step = 1e-4;
  return t;
}

TEST_F(SettlingTest, OverlapGivesNoSpeed) {
  Trial t = tight();
  t.settle = true;
  auto settled = start(t);
  settled->advance(0.01);
  EXPECT_LT(settled->stats().maxSpeed, 0.1) << "resolved within steps of 0.1 ms it would be tens of m/s";
  EXPECT_LT(settled->stats().densityErrorMean, 1e-3);
}

TEST_F(SettlingTest, TakesNoTime) {
  Trial t = tight();
  t.settle = true;
  auto run = start(t);
  run->advance(2e-4);
  EXPECT_EQ(run->progress().substeps, 2u) << "of 0.1 ms each";
  EXPECT_NEAR(run->stats().time_s, 2e-4, 1e-9);
}

TEST_F(SettlingTest, KeepsALatticeAtRest) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.settle = true;
  setWalls(t, {8 * t.d(), 8 * t.d(), 8 * t.d()});
  t.x = block({8, 8, 8}, t.d());
  auto run = start(t);
  run->advance(1e-3);
  const Snapshot after = run->snapshot();
  for (size_t i = 0; i < t.x.size(); ++i) ASSERT_LT(glm::length(after.x[i] - t.x[i]), 1e-4 * t.d()) << i;
}

/// A blob far from walls whose particles overlap each other and a body, under gravity.
Trial crowdedBlob() {
  Trial t = trial();
  t.x = block({8, 8, 8}, 0.85 * t.d());
  t.scene.solids = {bodies_test::crate({0.2, 0.25, 0.3}, 3 * t.d())};
  t.settle = true;
  t.step = 1e-4;
  return t;
}

// Pushes of bodies, gravity and corrections act in time alone, of which settling has none.
TEST_F(SettlingTest, LeavesNoSpeedAndNoMomentum) {
  const Trial t = crowdedBlob();
  const double particle = Oracle(t).solver().mass(), body = massOf(t.scene.solids[0]).mass;
  auto run = start(t);
  const auto momentum = [&](const Snapshot& now) { return particle * now.velocitySum() + body * reference::vec(motion(*run, 0).velocity); };
  FluidStep step{.advance_s = t.step, .substeps = 1};
  double moved = 0;
  Snapshot now = run->read(step);
  for (step.resume = true; run->control().phase == kPhaseSettling; now = run->read(step)) {
    for (size_t i = 0; i < t.x.size(); ++i) {
      ASSERT_EQ(now.v[i], glm::dvec3(0)) << i;
      moved = std::max(moved, glm::length(now.x[i] - t.x[i]));
    }
    ASSERT_EQ(momentum(now), glm::dvec3(0));
    ASSERT_EQ(reference::vec(motion(*run, 0).angularVelocity), glm::dvec3(0));
  }
  EXPECT_GT(moved, 0.1 * t.d()) << "nothing overlaps";
  ASSERT_EQ(run->progress().substeps, 1u);
  const double fall = (particle * double(t.x.size()) + body) * t.scene.gravity[1] * t.step;
  EXPECT_LT(glm::length(momentum(now) - glm::dvec3(0, fall, 0)), 0.01 * std::abs(fall)) << "all fall freely for one step";
}

}  // namespace settling_test
}  // namespace rill::test
