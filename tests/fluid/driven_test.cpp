// Solids that the host moves: where they go, how fast, and what the fluid makes of it.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "core/vector_math.hpp"
#include "fluid/rig.hpp"
#include "shape/records.hpp"
#include "shared/fluid_records.h"
#include "support/meshes.hpp"

namespace rill::test {
namespace driven_test {

constexpr double kFrame = 1.0 / 60;

Solid driven(Solid solid, double fastest) {
  solid.driven = fastest;
  return solid;
}

SolidTarget target(uint32_t solid, double x, double y, double z) { return {solid, {x, y, z}}; }

/// By an angle about an axis of unit length.
Quaternion rotation(double angle, const Double3& axis) {
  const double sine = std::sin(angle / 2);
  return {sine * axis.x, sine * axis.y, sine * axis.z, std::cos(angle / 2)};
}

/// Of the rotation between two unit quaternions, rad.
double angleBetween(const Quaternion& a, const Quaternion& b) { return length(turnBetween(a, b)); }

constexpr Double3 kAxis = {0.6, 0, 0.8};
constexpr glm::dvec3 kPaddle = {0.375, 0.3, 0.375}, kPaddleHalf = {0.2, 0.1, 0.05};

class DrivenTest : public FluidTest {
 protected:
  /// Particles in a tank, and a ball beside them.
  static Trial tank() {
    Trial t = trial();
    setWalls(t, {1, 0.5, 0.375});
    t.x = block({8, 6, 6}, t.d(), {}, 0.05);
    t.scene.solids = {driven(ball({0.75, 0.2, 0.1875}, 0.1), 5)};
    return t;
  }
  /// Particles in a tank around a paddle with friction, which is turned at the start.
  static Trial paddle() {
    Trial t = trial();
    setWalls(t, {0.75, 0.75, 0.75});
    t.scene.solids = {driven(slab(kPaddle - kPaddleHalf, kPaddle + kPaddleHalf), 20)};
    t.scene.solids[0].rotation = rotation(0.3, {0, 1, 0});
    t.scene.solids[0].friction = 0.3;
    addOutsideSolids(t, block({10, 7, 10}, t.d(), {0.0625, 0, 0.0625}, 0.05));
    return t;
  }
  /// The paddle at the end of the n-th of some advances.
  static SolidTarget paddleTarget(int n, double turn) {
    return {0, {kPaddle.x, kPaddle.y + 0.01 * n, kPaddle.z}, turned(rotation(0.3, {0, 1, 0}), n * turn, kAxis)};
  }
  /// What the device says of the solids.
  std::vector<SolidRecord> solidsOf(Fluid& fluid) {
    Graph graph;
    const FluidState state = fluid.present(graph);
    const Ticket ticket = graph.readback(state.solids);
    runGraph(graph);
    return read<SolidRecord>(graph, ticket);
  }
};

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
