// Fluid falls asleep around solids and bodies: what rests on them does not count as motion.
#include "fluid/rig.hpp"

namespace rill::test {
namespace sleep_at_solids_test {

constexpr double kFrame = 1.0 / 60;
constexpr uint32_t kPiece = 42;  // substeps recorded: little more than a frame takes

/// A tank of 14 by 14 spacings with the solver's defaults, whose fluid may sleep, around a solid.
Trial tankAround(const Solid& solid, int layers) {
  Trial t = trial();
  t.scene.fluid = {.spacing = 0.02};
  t.scene.solver = SolverSettings{};
  t.scene.solver.sleep = true;
  setWalls(t, glm::dvec3(14, 3 * layers, 14) * t.d());
  t.step = kFrame;
  t.scene.solids = {solid};
  t.x.clear();
  addOutsideSolids(t, block({14, layers, 14}, t.d()));
  return t;
}

Solid ballOnFloor() { return ball({0.1, 0.03, 0.1}, 0.03); }

class SleepAtSolidsTest : public FluidTest {
 protected:
  void expectSleepWithin(double seconds, const Trial& t) {
    auto run = start(t);
    while (run->progress().time_s < seconds && !run->progress().asleep) run->advance(kFrame, kPiece);
    EXPECT_TRUE(run->progress().asleep);
    EXPECT_GT(run->progress().time_s, 1) << "it fell asleep before it had settled";
  }
};

TEST_F(SleepAtSolidsTest, FallsAsleepAroundBallOnFloor) { expectSleepWithin(12, tankAround(ballOnFloor(), 5)); }

TEST_F(SleepAtSolidsTest, FallsAsleepAroundSunkenBody) {
  Solid body = ballOnFloor();
  body.body = Body{.density = 2000};
  expectSleepWithin(12, tankAround(body, 5));
}

TEST_F(SleepAtSolidsTest, FallsAsleepAroundFloatingCrate) {
  Solid crate = slab({0.1, 0.08, 0.1}, {0.18, 0.16, 0.18});
  crate.body = Body{.density = 500};
  expectSleepWithin(30, tankAround(crate, 6));
}

}  // namespace sleep_at_solids_test
}  // namespace rill::test
