// Solids that the host moves: where they go, how fast, and what the fluid makes of it. Rotations: driven_rotation_test.cpp.
#include <limits>
#include <random>

#include "fluid/driven_fixture.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace driven_test {

TEST_F(DrivenTest, EqualsKeyframedSolidOnTheSamePath) {
  Trial host = tank(), keyed = tank();
  host.scene.solids[0].driven = 2;  // the limits of speeds follow from it
  const double speed = 2, advance = 10 * host.step;
  keyed.scene.solids[0].driven = 0;
  keyed.scene.solids[0].motion = {{0, {0, 0, 0}}, {1, {-speed, 0, 0}}};
  auto pushed = start(host), followed = start(keyed);
  Oracle oracle(keyed);
  for (int n = 1; n <= 12; ++n) {
    pushed->targets = {target(0, 0.75 - n * speed * advance, 0.2, 0.1875)};
    pushed->advance(advance);
    followed->advance(advance);
    oracle.advance(10);
  }
  const Snapshot a = pushed->snapshot(), b = followed->snapshot();
  double apart = 0, wrong = 0, moved = 0;
  for (size_t i = 0; i < a.x.size(); ++i) {
    apart = std::max(apart, glm::length(a.x[i] - b.x[i]));
    wrong = std::max(wrong, glm::length(a.x[i] - oracle.solver().state.position[i]));
    moved = std::max(moved, glm::length(a.x[i] - host.x[i]));
  }
  EXPECT_GT(moved, host.d()) << "it has pushed them";
  EXPECT_LT(apart, 0.005 * host.d());
  EXPECT_LT(wrong, 0.08 * host.d()) << "0.053 was measured: in 120 substeps a flow amplifies rounding";
}

TEST_F(DrivenTest, MovesMeshesAsKeyframesDo) {
  Trial host = tank(), keyed = tank();
  const double speed = 2, advance = 10 * host.step;
  const Solid ball{.shape = MeshShape{.mesh = meshOf(ballMesh(0.1, 3))}, .translation = {0.75, 0.2, 0.1875}};
  host.scene.solids = {driven(ball, 2)};
  keyed.scene.solids = {ball};
  keyed.scene.solids[0].motion = {{0, {0, 0, 0}}, {1, {-speed, 0, 0}}};
  auto pushed = start(host), followed = start(keyed);
  for (int n = 1; n <= 12; ++n) {
    pushed->targets = {target(0, 0.75 - n * speed * advance, 0.2, 0.1875)};
    pushed->advance(advance);
    followed->advance(advance);
  }
  const Snapshot a = pushed->snapshot(), b = followed->snapshot();
  double apart = 0, moved = 0;
  for (size_t i = 0; i < a.x.size(); ++i) {
    apart = std::max(apart, glm::length(a.x[i] - b.x[i]));
    moved = std::max(moved, glm::length(a.x[i] - host.x[i]));
  }
  EXPECT_GT(moved, host.d()) << "it has pushed them";
  EXPECT_LT(apart, 0.02 * host.d());
}

TEST_F(DrivenTest, KeepsToItsMaximumSpeed) {
  const Trial t = tank();
  auto run = start(t);
  run->targets = {target(0, 0.75, 100, 0.1875)};
  run->advance(0.02);
  const auto center = run->fluid().drivenCenter(0);
  EXPECT_NEAR(center[1], 0.2 + 5 * 0.02, 1e-6);
  const auto records = solidsOf(run->fluid());
  ASSERT_EQ(records.size(), 1u);
  EXPECT_NEAR(records[0].pose.centerY, center[1], 1e-6) << "the same pose on the device";
  EXPECT_NEAR(records[0].pose.velocityY, 5, 1e-4);
  run->targets.clear();
  run->advance(0.02);
  EXPECT_EQ(run->fluid().drivenCenter(0), center) << "a solid without a target stays";
  EXPECT_EQ(solidsOf(run->fluid())[0].pose.velocityY, 0);
  run->targets = {target(0, std::numeric_limits<double>::quiet_NaN(), 0, 0)};
  run->advance(0.02);
  EXPECT_EQ(run->fluid().drivenCenter(0), center) << "so does one whose target is not finite";
}

TEST_F(DrivenTest, MovesDrivenSolidsOnly) {
  Trial t = tank();
  t.scene.solids = {slab({0.9, 0, 0}, {1, 0.2, 0.1}), driven(slab({0.6, 0, 0}, {0.7, 0.2, 0.1}), 1),
                    driven(ball({0.8, 0.3, 0.2}, 0.05), 1)};
  t.scene.solids[0].motion = {{0, {0, 0, 0}}, {0.1, {0, 0.1, 0}}};
  auto run = start(t);
  run->targets = {target(0, 0, 0, 0), target(2, 0.8, 0.29, 0.2), target(1, 0.66, 0.1, 0.05)};
  run->advance(0.02);
  const auto records = solidsOf(run->fluid());
  ASSERT_EQ(records.size(), 3u);
  EXPECT_NEAR(records[0].pose.centerY, 0.1 + 0.02, 1e-6) << "its keyframes move it";
  EXPECT_NEAR(records[1].pose.centerX, 0.66, 1e-6);
  EXPECT_NEAR(records[2].pose.centerY, 0.29, 1e-6);
}

TEST_F(DrivenTest, DoesNotDependOnPieceSize) {
  std::vector<Snapshot> ends;
  for (uint32_t piece : {64u, 6u}) {
    auto run = start(tank());
    for (int n = 1; n <= 3; ++n) {
      run->targets = {target(0, 0.75 - 0.05 * n, 0.2, 0.1875)};
      run->advance(kFrame, piece);
    }
    ends.push_back(run->snapshot());
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TEST_F(DrivenTest, ContinuesFromASnapshot) {
  const Trial t = tank();
  auto straight = start(t);
  straight->targets = {target(0, 0.6, 0.2, 0.1875)};
  straight->advance(kFrame);
  const FluidSnapshot saved = straight->saved();
  auto resumed = start(t, &saved);
  EXPECT_EQ(resumed->fluid().drivenCenter(0), straight->fluid().drivenCenter(0));
  straight->advance(kFrame);
  resumed->targets = straight->targets;
  resumed->advance(kFrame);
  EXPECT_EQ(straight->snapshot(), resumed->snapshot());
}

TEST_F(DrivenTest, SurvivesRandomTargets) {
  Trial t = tank();
  t.scene.solids = {driven(ball({0.75, 0.25, 0.1875}, 0.1), 20)};
  t.scene.solver = {};  // as a viewer runs it
  t.step = kFrame;
  auto run = start(t);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-0.5, 1.5);
  for (int frame = 0; frame < 50; ++frame) {
    run->targets = {target(0, anywhere(random), anywhere(random), anywhere(random))};
    run->advance(kFrame);
    const FluidStats stats = run->stats();
    ASSERT_TRUE(run->measured().finite()) << frame;
    ASSERT_EQ(stats.nonFinite, 0u) << frame;
    ASSERT_EQ(stats.outside, 0u) << frame;
    ASSERT_EQ(stats.particles, t.x.size());
    ASSERT_LE(stats.maxSpeed, 8 * (20 + std::sqrt(2 * 9.81 * 0.5) + 1e-3)) << "the limit of any speed";
  }
  run->targets = {target(0, 0.5, 3, 0.2)};  // away
  for (int frame = 0; frame < 80; ++frame) run->advance(kFrame);
  const FluidStats calm = run->stats();
  EXPECT_LT(calm.maxSpeed, 1) << "it comes to rest";
  EXPECT_LT(calm.densityErrorMean, 0.005);
}

TEST_F(DrivenTest, RejectsInvalidTargets) {
  for (double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Trial t = tank();
    t.scene.solids[0].driven = bad;
    const ParticleSet particles = t.particles();
    const auto made = Fluid::create(device(), {.scene = &t.scene, .particles = &particles});
    ASSERT_FALSE(made) << bad;
    EXPECT_EQ(made.error().kind, ErrorKind::BadInput);
    EXPECT_NE(made.error().message.find("solids[0].driven"), std::string::npos) << made.error().message;
  }
  Trial t = tank();
  t.scene.solids[0].motion = {{0, {0, 0, 0}}, {1, {1, 0, 0}}};
  const ParticleSet particles = t.particles();
  const auto made = Fluid::create(device(), {.scene = &t.scene, .particles = &particles});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("motion"), std::string::npos) << made.error().message;
}

}  // namespace driven_test
}  // namespace rill::test
