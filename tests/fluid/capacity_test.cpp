// A fluid with room for more particles than it has.
#include <cmath>

#include "fluid/rig.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace capacity_test {

Trial tank(glm::ivec3 count = {7, 6, 5}) {
  Trial t = trial();
  setWalls(t, {0.75, 1, 0.5});
  t.x = block(count, t.d(), {0.06, 0.06, 0.06}, 0.05);
  t.scene.fluid.viscosity = 0.05;
  t.scene.fluid.vorticity = 0.1;
  return t;
}

class CapacityTest : public FluidTest {};

TEST_F(CapacityTest, StepsLikeTheReferenceHoweverMuchRoomThereIs) {
  Trial t = tank();
  t.scene.solids = {ball({0.3, 0.6, 0.2}, 0.1)};
  t.scene.solver.iterations = 2;
  for (const uint32_t capacity : {211u, 256u, 257u, 5000u}) {
    SCOPED_TRACE(capacity);
    t.capacity = capacity;
    expectEqual(t, 12, 2e-4, 2e-4);
  }
}

// More particles than a bin of the sort holds lie in few cells, so that the sort is by digits, over all keys.
TEST_F(CapacityTest, SortsByDigitsWithRoomToSpare) {
  Trial t = trial();
  t.x = cloud(70000, 0.5, 3);
  setWalls(t, {0.5, 0.5, 0.5});
  t.capacity = 100000;
  auto run = start(t);
  run->advance(t.step, 12);
  const Snapshot after = run->snapshot();
  ASSERT_EQ(after.x.size(), t.x.size());
  EXPECT_TRUE(after.finite());
  EXPECT_EQ(run->stats().particles, t.x.size());
}

TEST_F(CapacityTest, FiguresAreThoseOfTheParticlesAlone) {
  Trial t = tank();
  auto exact = start(t);
  exact->substeps(5);
  const FluidStats wanted = exact->stats();
  t.capacity = 4000;
  auto roomy = start(t);
  EXPECT_EQ(roomy->fluid().count(), t.x.size());
  EXPECT_EQ(roomy->fluid().capacity(), 4000u);
  roomy->substeps(5);
  const FluidStats got = roomy->stats();
  EXPECT_EQ(got.particles, t.x.size());
  EXPECT_EQ(got.outside, wanted.outside);
  EXPECT_NEAR(got.densityErrorMean, wanted.densityErrorMean, 1e-5);
  EXPECT_NEAR(got.densitySignedMedian, wanted.densitySignedMedian, 1e-3);
  EXPECT_NEAR(got.kinetic_J, wanted.kinetic_J, 1e-4 * wanted.kinetic_J);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(got.centerOfMass[a], wanted.centerOfMass[a], 1e-5);
}

TEST_F(CapacityTest, RunsWithoutParticles) {
  Trial t = tank();
  t.x.clear();
  t.capacity = 300;
  auto run = start(t);
  run->advance(0.05, 64);
  const FluidStats stats = run->stats();
  EXPECT_EQ(stats.particles, 0u);
  EXPECT_EQ(stats.kinetic_J, 0);
  EXPECT_EQ(stats.densityErrorMax, 0);
  EXPECT_NEAR(stats.time_s, 0.05, 1e-6);
  EXPECT_TRUE(run->saved().id.empty());
}

// The state of a fluid goes on in one with more room, with particles that were not there before and with ids that have gaps.
TEST_F(CapacityTest, TakesParticlesInThroughASnapshot) {
  Trial t = tank();
  auto before = start(t);
  before->substeps(4);
  FluidSnapshot state = before->saved();
  state.id.back() = 500000;
  const std::vector<Float3> more = {{0.1f, 0.8f, 0.1f}, {0.2f, 0.8f, 0.1f}, {0.3f, 0.8f, 0.1f}};
  append(state, more, std::vector<Float3>(more.size()));
  t.capacity = 1000;
  auto after = start(t, &state);
  EXPECT_EQ(after->fluid().count(), t.x.size() + more.size());
  after->substeps(4);
  const FluidSnapshot then = after->saved();
  EXPECT_EQ(then.id.size(), t.x.size() + more.size());
  std::vector<uint32_t> ids = then.id;
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(ids.back(), 500003u);
  const auto last = static_cast<size_t>(std::find(then.id.begin(), then.id.end(), 500003u) - then.id.begin());
  EXPECT_NEAR(then.position[last].x, 0.3f, 1e-3f);
  EXPECT_LT(then.position[last].y, 0.8f) << "it falls";
}

}  // namespace capacity_test
}  // namespace rill::test
