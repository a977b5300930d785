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
  const Vec3 above = {1, 2, 0}, center = {1, 0, 0};
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), above).distance, 1.5);
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), above).normal[1], 1);
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), center).distance, -0.5);
  EXPECT_DOUBLE_EQ(surfaceAt(ball.shape, solidPose(ball, 0), center).normal[1], 1);

  Solid box;
  box.shape = BoxShape{{-2, -1, -1}, {2, 1, 1}};
  box.rotation[2] = box.rotation[3] = std::sqrt(0.5);  // a quarter turn about z: long along y
  const Pose pose = solidPose(box, 0);
  const Vec3 top = {0, 3, 0}, inside = {0.9, 0.5, 0}, corner = {1 + 3, 2 + 4, 0};
  EXPECT_NEAR(surfaceAt(box.shape, pose, top).distance, 1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, top).normal[1], 1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, inside).distance, -0.1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, inside).normal[0], 1, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, corner).distance, 5, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, corner).normal[0], 0.6, 1e-12);
  EXPECT_NEAR(surfaceAt(box.shape, pose, corner).normal[1], 0.8, 1e-12);
}

}  // namespace
}  // namespace rill::test
