// Particles that overlap at the start part before time begins, and gain no speed by it.
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"

namespace rill::test {
namespace settling_test {

using SettlingTest = FluidTest;

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

}  // namespace settling_test
}  // namespace rill::test
