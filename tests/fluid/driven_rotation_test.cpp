// Solids that the host turns: which rotation they reach, how fast, and what the fluid makes of it.
#include <limits>
#include <random>

#include "fluid/driven_fixture.hpp"

namespace rill::test {
namespace driven_test {

// The reference knows keyframes only.
TEST_F(DrivenTest, TurnsAsKeyframesDo) {
  Trial host = paddle(), keyed = paddle();
  constexpr int kAdvances = 3;
  constexpr double kTurn = 0.1;
  const double advance = 10 * host.step;
  host.scene.solids[0].driven = (0.01 + kTurn * glm::length(kPaddleHalf)) / advance;  // the limits of speeds follow from it
  keyed.scene.solids[0].driven = 0;
  for (int n = 0; n <= kAdvances + 1; ++n)
    keyed.scene.solids[0].motion.push_back({n * advance, {0, 0.01 * n, 0}, rotation(n * kTurn, kAxis)});
  auto pushed = start(host), followed = start(keyed), still = start(host);
  Oracle oracle(keyed);
  for (int n = 1; n <= kAdvances; ++n) {
    pushed->targets = {paddleTarget(n, kTurn)};
    for (auto* run : {&pushed, &followed, &still}) (*run)->advance(advance);
    oracle.advance(10);
  }
  const Snapshot a = pushed->snapshot(), b = followed->snapshot(), c = still->snapshot();
  double apart = 0, wrong = 0, stirred = 0;
  for (size_t i = 0; i < a.x.size(); ++i) {
    apart = std::max(apart, glm::length(a.x[i] - b.x[i]));
    wrong = std::max(wrong, glm::length(a.x[i] - oracle.solver().state.position[i]));
    stirred = std::max(stirred, glm::length(a.x[i] - c.x[i]));
  }
  EXPECT_GT(stirred, 0.3 * host.d());
  EXPECT_LT(apart, 0.005 * host.d());
  EXPECT_LT(wrong, 0.02 * host.d());
}

TEST_F(DrivenTest, ReachesItsRotation) {
  auto run = start(paddle());
  const Quaternion first = rotation(0.3, {0, 1, 0}), wanted = turned(first, 0.4, kAxis);
  run->targets = {{0, {kPaddle.x, kPaddle.y, kPaddle.z}, Quaternion{-7 * wanted.x, -7 * wanted.y, -7 * wanted.z, -7 * wanted.w}}};
  run->read({.advance_s = 0.02, .substeps = 10, .targets = run->targets});
  const PoseRecord midway = solidsOf(run->fluid())[0].pose;
  const double share = 1 - run->progress().timeLeft_s / 0.02;
  ASSERT_NEAR(share, 0.5, 0.2);
  EXPECT_NEAR(angleBetween(first, rotationOf(midway)), share * 0.4, 1e-5);
  for (const auto& [found, part] : {std::pair{midway.angularX, kAxis.x}, {midway.angularY, kAxis.y}, {midway.angularZ, kAxis.z}})
    EXPECT_NEAR(found, part * 0.4 / 0.02, 1e-4) << "rad/s, the shorter way";
  run->read({.resume = true});
  EXPECT_LT(angleBetween(rotationOf(solidsOf(run->fluid())[0].pose), wanted), 1e-6);
  EXPECT_EQ(run->fluid().drivenRotation(0), rotationOf(solidsOf(run->fluid())[0].pose)) << "the same numbers as on the device";

  const Quaternion reached = run->fluid().drivenRotation(0);
  run->targets = {target(0, kPaddle.x, kPaddle.y + 0.01, kPaddle.z)};
  run->advance(0.02);
  EXPECT_EQ(run->fluid().drivenRotation(0), reached) << "it keeps the rotation without one in the target";
  EXPECT_EQ(solidsOf(run->fluid())[0].pose.angularX, 0);
  run->targets = {{0, {std::numeric_limits<double>::infinity(), 0, 0}, first}};
  run->advance(0.02);
  EXPECT_EQ(run->fluid().drivenRotation(0), reached) << "a center that is not finite stops both";
}

TEST_F(DrivenTest, NoPointExceedsItsMaximumSpeed) {
  Trial t = paddle();
  t.scene.solids[0].driven = 2;
  auto run = start(t);
  const Quaternion first = rotation(0.3, {0, 1, 0});
  const SolidTarget far{0, {kPaddle.x, kPaddle.y + 0.1, kPaddle.z}, turned(first, 1.5, kAxis)};
  run->read({.advance_s = 0.02, .targets = {&far, 1}});
  const double radius = glm::length(kPaddleHalf), share = 2 * 0.02 / (0.1 + 1.5 * radius);
  EXPECT_NEAR(run->fluid().drivenCenter(0)[1], kPaddle.y + share * 0.1, 1e-6);
  EXPECT_NEAR(angleBetween(first, run->fluid().drivenRotation(0)), share * 1.5, 1e-6);
  const PoseRecord pose = solidsOf(run->fluid())[0].pose;
  EXPECT_NEAR(pose.velocityY + radius * std::hypot(pose.angularX, pose.angularY, pose.angularZ), 2, 1e-4);
  EXPECT_NEAR(run->control().solidSpeed, 2, 1e-5) << "what the list's travel counts on";
}

// A ball keeps its shape: only friction, by the velocity of its surface, moves the fluid.
TEST_F(DrivenTest, TurningBallDragsByFriction) {
  const auto stirred = [&](double friction) {
    Trial t = trial();
    setWalls(t, {1, 0.5, 1});
    t.scene.solids = {driven(ball({0.5, 0.25, 0.5}, 0.2), 20)};
    t.scene.solids[0].friction = friction;
    addOutsideSolids(t, block({14, 6, 14}, t.d(), {0.0625, 0.0625, 0.0625}, 0.05));
    auto run = start(t);
    for (int n = 1; n <= 4; ++n) {
      run->targets = {{0, {0.5, 0.25, 0.5}, rotation(0.1 * n, {0, 1, 0})}};
      run->substeps(10);
    }
    const Snapshot s = run->snapshot();
    double sum = 0;
    for (size_t i = 0; i < s.x.size(); ++i) sum += glm::cross(s.x[i] - glm::dvec3(0.5, 0.25, 0.5), s.v[i]).y;
    return sum;
  };
  EXPECT_GT(stirred(0.5) - stirred(0), 0.1) << "m^2/s";
}

TEST_F(DrivenTest, TurnsTheSameInAnyPieces) {
  std::vector<Snapshot> ends;
  for (uint32_t piece : {64u, 6u, 64u}) {
    auto run = start(paddle());
    for (int n = 1; n <= 3; ++n) {
      run->targets = {paddleTarget(n, 0.15)};
      run->advance(kFrame, piece);
    }
    ends.push_back(run->snapshot());
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_EQ(ends[0], ends[2]);
}

TEST_F(DrivenTest, TurnsOnFromASnapshot) {
  const Trial t = paddle();
  auto straight = start(t);
  straight->targets = {paddleTarget(1, 0.2)};
  straight->advance(kFrame);
  const FluidSnapshot saved = straight->saved();
  auto resumed = start(t, &saved);
  EXPECT_EQ(resumed->fluid().drivenCenter(0), straight->fluid().drivenCenter(0));
  EXPECT_EQ(resumed->fluid().drivenRotation(0), straight->fluid().drivenRotation(0));
  for (int n = 2; n <= 3; ++n)
    for (auto* run : {&straight, &resumed}) {
      (*run)->targets = {paddleTarget(n, 0.2)};
      (*run)->advance(kFrame);
    }
  EXPECT_EQ(straight->snapshot(), resumed->snapshot());
  EXPECT_EQ(straight->saved().solids, resumed->saved().solids);
}

TEST_F(DrivenTest, SurvivesRandomRotations) {
  Trial t = paddle();
  t.scene.solver = {};
  t.step = kFrame;
  auto run = start(t);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> anywhere(-0.2, 1), any(-1, 1);
  for (int frame = 0; frame < 20; ++frame) {
    run->targets = {
        {0, {anywhere(random), anywhere(random), anywhere(random)}, Quaternion{any(random), any(random), any(random), any(random)}}};
    run->advance(kFrame);
    const FluidStats stats = run->stats();
    ASSERT_TRUE(run->measured().finite()) << frame;
    ASSERT_EQ(stats.nonFinite, 0u) << frame;
    ASSERT_EQ(stats.outside, 0u) << frame;
    const Quaternion q = run->fluid().drivenRotation(0);
    ASSERT_NEAR(std::hypot(std::hypot(q.x, q.y, q.z), q.w), 1, 1e-6) << frame;
  }
}

}  // namespace driven_test
}  // namespace rill::test
