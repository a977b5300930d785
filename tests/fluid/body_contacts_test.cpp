// Rigid bodies that touch solids, walls and each other.
#include "fluid/bodies_fixture.hpp"

namespace rill::test {
namespace bodies_test {

TEST_F(BodiesTest, ContactsMatchReference) {
  Trial t = dry();
  t.scene.solids[1].friction = 0.2;
  t.scene.solids[3].friction = 0.9;
  t.scene.solids[4].restitution = 0.4;
  t.scene.solids.push_back(body(eccentricBall({0.4, 1.3, 0.6}, 0.15), 900));
  t.step = 2e-3;
  expectReferenceMotion(t, 60, 1e-3);
  expectReferenceMotion(t, 200, 2e-2);
}

TEST_F(BodiesTest, ConserveMomentumInContacts) {
  Trial t = trial();
  t.capacity = 1;
  t.scene.gravity[1] = 0;
  t.scene.solids = {body(ball({0, 0, 0}, 0.2), 1000, {2, 0.5, 0}), turned(crate({0.5, 0.1, 0}, 0.4, 300), {1, 1, 0}, 0.4),
                    turned(crate({1.0, 0, 0.1}, 0.3, 6000), {0, 1, 0}, 0.3)};
  glm::dvec3 before(0), after(0);
  auto run = start(t);
  for (size_t n = 0; n < 3; ++n) before += massOf(t.scene.solids[n]).mass * vec(motion(*run, n).velocity);
  runFor(*run, 0.3);
  for (size_t n = 0; n < 3; ++n) after += massOf(t.scene.solids[n]).mass * vec(motion(*run, n).velocity);
  EXPECT_GT(glm::length(vec(motion(*run, 2).velocity)), 0.01) << "they did not meet";
  EXPECT_LT(glm::length(after - before), 1e-5 * glm::length(before));
}

TEST_F(BodiesTest, FrictionHoldsThemOnSlopesUpToItsAngle) {
  const double friction = 0.4;
  for (const double angle : {0.9 * std::atan(friction), 1.2 * std::atan(friction)}) {
    SCOPED_TRACE(angle);
    Trial t = trial();
    t.capacity = 1;
    Solid ramp = turned(slab({-3, -0.2, -0.5}, {3, 0, 0.5}), {0, 0, 1}, angle);
    const glm::dvec3 normal = quat(ramp.rotation) * glm::dvec3(0, 1, 0), middle(0, -0.1, 0);
    ramp.friction = friction;
    Solid box = turned(crate(middle + (0.1 + 0.1) * normal, 0.2), {0, 0, 1}, angle);
    t.scene.solids = {ramp, box};
    t.step = 2e-3;
    auto run = start(t);
    runFor(*run, 1);
    const double down = glm::length(vec(motion(*run, 1).center) - vec(centerOf(box)));
    const double slides = std::max(0.0, 0.5 * 9.81 * (std::sin(angle) - friction * std::cos(angle)));
    EXPECT_NEAR(down, slides, 0.05 * slides + 2e-3);
  }
}

TEST_F(BodiesTest, BounceByRestitution) {
  Trial t = trial();
  t.capacity = 1;
  setWalls(t, {2, 4, 2});
  Solid sphere = body(ball({1, 1.2, 1}, 0.2), 500);
  sphere.restitution = 0.5;
  t.scene.solids = {sphere};
  auto run = start(t);
  runFor(*run, std::sqrt(2 / 9.81) + 0.05);
  EXPECT_NEAR(motion(*run, 0).velocity.y, 0.5 * std::sqrt(2 * 9.81) - 0.05 * 9.81, 0.05);
}

TEST_F(BodiesTest, PyramidsStand) {
  const Trial t = pyramid();
  auto run = start(t);
  runFor(*run, 2);
  for (size_t n = 0; n < t.scene.solids.size(); ++n) {
    EXPECT_LT(glm::length(vec(motion(*run, n).center) - vec(centerOf(t.scene.solids[n]))), 0.01) << n;
    EXPECT_LT(glm::length(vec(motion(*run, n).velocity)), 1e-3) << n;
  }
}

// Heavy crates on light ones, and a tower of equal ones.
TEST_F(BodiesTest, LowestCratesBearTheirStacks) {
  constexpr double kEdge = 0.1;
  const std::vector<std::vector<double>> stacks = {{300, 2000, 2000}, {50, 2000}, std::vector<double>(16, 500)};
  Trial t = trial();
  t.capacity = 1;
  setWalls(t, {1, 2, 0.5});
  t.step = 4e-3;
  double x = 0.2;
  for (const std::vector<double>& densities : stacks) {
    for (size_t k = 0; k < densities.size(); ++k)
      t.scene.solids.push_back(crate({x, kEdge * (0.5 + double(k)), 0.25}, kEdge, densities[k]));
    x += 0.3;
  }
  auto run = start(t);
  runFor(*run, 1);
  size_t n = 0;
  for (const std::vector<double>& densities : stacks)
    for (size_t k = 0; k < densities.size(); ++k, ++n)
      EXPECT_LT(glm::length(vec(motion(*run, n).center) - vec(centerOf(t.scene.solids[n]))), 0.01 * double(k + 1) * kEdge + 0.03 * kEdge)
          << n;
}

TEST_F(BodiesTest, CountMoreSolidsThanOneTouches) {
  Trial t = trial();
  t.capacity = 1;
  t.scene.solids = {crate({0, 0, 0}, 1)};
  for (int k = 0; k < 40; ++k) t.scene.solids.push_back(ball({0.02 * k - 0.4, 0.52, 0}, 0.05));
  auto run = start(t);
  run->substeps(1);
  EXPECT_EQ(run->stats().loopBoundHits, 40u - kMaxTouched);
}

}  // namespace bodies_test
}  // namespace rill::test
