#include "shape/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rill::test {
namespace {

TEST(Pose, InterpolatesKeyframes) {
  Solid solid;
  solid.shape = SphereShape{{1, 2, 3}, 0.5};
  EXPECT_EQ(solidPose(solid, 5).center[0], 1);
  EXPECT_EQ(solidPose(solid, 5).velocity[0], 0);
  solid.motion = {{1, {1, 0, 0}}, {3, {5, 0, 0}}, {4, {5, -2, 0}}};
  EXPECT_DOUBLE_EQ(solidPose(solid, 0).center[0], 2);
  EXPECT_DOUBLE_EQ(solidPose(solid, 0).velocity[0], 0);
  EXPECT_DOUBLE_EQ(solidPose(solid, 2).center[0], 4);
  EXPECT_DOUBLE_EQ(solidPose(solid, 2).velocity[0], 2);
  EXPECT_DOUBLE_EQ(solidPose(solid, 3).velocity[0], 0);
  EXPECT_DOUBLE_EQ(solidPose(solid, 3).velocity[1], -2);
  EXPECT_DOUBLE_EQ(solidPose(solid, 3.5).center[1], 1);
  EXPECT_DOUBLE_EQ(solidPose(solid, 9).center[1], 0);
  EXPECT_DOUBLE_EQ(solidPose(solid, 9).velocity[1], 0);
  const Pose step = solidPose(solid, 2.5, 1.0);  // half a second at 2 m/s in x, half at -2 in y
  EXPECT_DOUBLE_EQ(step.velocity[0], 1);
  EXPECT_DOUBLE_EQ(step.velocity[1], -1);
  EXPECT_DOUBLE_EQ(step.center[1], 1);
}

TEST(Pose, ComputesSurfaceOfSpheresAndRotatedBoxes) {
  Solid ball;
  ball.shape = SphereShape{{1, 0, 0}, 0.5};
  const Double3 above = {1, 2, 0}, center = {1, 0, 0};
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), above).distance, 1.5);
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), above).normal[1], 1);
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), center).distance, -0.5);
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), center).normal[1], 1);

  Solid box;
  box.shape = BoxShape{{-2, -1, -1}, {2, 1, 1}};
  box.rotation[2] = box.rotation[3] = std::sqrt(0.5);  // a quarter turn about z: long along y
  const Pose pose = solidPose(box, 0);
  const Double3 top = {0, 3, 0}, inside = {0.9, 0.5, 0}, corner = {1 + 3, 2 + 4, 0};
  EXPECT_NEAR(surfaceAt(box.shape, pose, top).distance, 1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, top).normal[1], 1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, inside).distance, -0.1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, inside).normal[0], 1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, corner).distance, 5, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, corner).normal[0], 0.6, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, corner).normal[1], 0.8, 1e-12);
}

/// A turn about a unit axis, rad.
Quaternion turn(double x, double y, double z, double angle) {
  return {x * std::sin(angle / 2), y * std::sin(angle / 2), z * std::sin(angle / 2), std::cos(angle / 2)};
}

Keyframe keyframe(double at, const Quaternion& q) { return {at, {0, 0, 0}, {q[0], q[1], q[2], q[3]}}; }

/// A box of 2 m at the origin that turns from one rotation to another between 1 and 3 s.
Solid turning(const Quaternion& from, const Quaternion& to) {
  return {.shape = BoxShape{{-1, -1, -1}, {1, 1, 1}}, .motion = {keyframe(1, from), keyframe(3, to)}};
}

constexpr double kQuarter = 1.5707963267948966, kTurned = 1e-12;

TEST(Pose, TurnsAtConstantSpeedBetweenKeyframes) {
  const Solid box = turning({0, 0, 0, 1}, turn(0, 1, 0, kQuarter));
  for (const double t : {1.0, 1.5, 2.0, 2.9}) {
    const Pose pose = solidPose(box, t);
    EXPECT_NEAR(pose.angularVelocity[1], kQuarter / 2, kTurned) << t;
    const Double3 x = toScene(pose, {1, 0, 0});
    const double angle = (t - 1) * kQuarter / 2;
    EXPECT_NEAR(x[0], std::cos(angle), kTurned) << t;
    EXPECT_NEAR(x[2], -std::sin(angle), kTurned) << t;
  }
  EXPECT_EQ(solidPose(box, 0.5).angularVelocity[1], 0);
  EXPECT_EQ(solidPose(box, 3).angularVelocity[1], 0);
  EXPECT_NEAR(toScene(solidPose(box, 9), {1, 0, 0})[2], -1, kTurned);
  EXPECT_NEAR(solidPose(box, 2.5, 1).angularVelocity[1], kQuarter / 4, kTurned) << "at rest for half of it";
}

TEST(Pose, TurnsTheShorterWay) {
  const Quaternion near = turn(0, 1, 0, 0.2),
                   far = {-near.x, -near.y, -near.z, -near.w};  // the same rotation, the longer way in four dimensions
  EXPECT_NEAR(solidPose(turning({0, 0, 0, 1}, far), 2).angularVelocity[1], 0.1, kTurned);
  EXPECT_NEAR(solidPose(turning({0, 0, 0, 1}, turn(0, 1, 0, 3.5 * kQuarter)), 2).angularVelocity[1], -0.25 * kQuarter, kTurned);
}

TEST(Pose, HandlesEqualAndOppositeRotations) {
  const Quaternion odd = turn(0.6, 0, 0.8, 1.1);
  EXPECT_LT(std::abs(solidPose(turning(odd, odd), 2).angularVelocity[0]), 1e-15);
  const Pose half = solidPose(turning({0, 0, 0, 1}, turn(0, 0, 1, 2 * kQuarter)), 2);
  EXPECT_NEAR(std::abs(half.angularVelocity[2]), kQuarter, kTurned);
  EXPECT_NEAR(std::abs(toScene(half, {1, 0, 0})[1]), 1, kTurned) << "either way round, but in the plane";
}

TEST(Pose, RotatesAfterTheInitialRotation) {
  Solid box = turning(turn(0, 1, 0, kQuarter), turn(0, 1, 0, kQuarter));
  const Quaternion initial = turn(0, 0, 1, kQuarter);
  box.rotation = initial;
  const Double3 x = toScene(solidPose(box, 0), {1, 0, 0});  // to y, which the keyframe leaves alone
  EXPECT_NEAR(x[1], 1, kTurned);
}

TEST(Pose, VelocityIsTheDerivativeOfThePoint) {
  Solid box = turning(turn(0.6, 0, 0.8, 0.3), turn(0, 1, 0, 2));
  box.motion[1].translate[0] = 3;
  const Pose pose = solidPose(box, 1.7), later = solidPose(box, 1.7 + 1e-6);
  const Double3 local = {0.3, -0.8, 0.5}, now = toScene(pose, local), then = toScene(later, local);
  Double3 x;
  for (size_t a = 0; a < 3; ++a) x[a] = pose.center[a] + now[a];
  const Double3 v = velocityAt(pose, x);
  for (size_t a = 0; a < 3; ++a) EXPECT_NEAR(v[a], (later.center[a] + then[a] - x[a]) / 1e-6, 1e-5) << a;
}

}  // namespace
}  // namespace rill::test
