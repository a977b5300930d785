// What lies under the pointer, by geometry alone.
#include "view/pick.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rill::view {
namespace {

CameraView ahead() { return {.eye = {0, 0, 5}, .target = {0, 0, 0}, .fov_y_deg = 90}; }

Solid box(double half) { return {.shape = BoxShape{{-half, -half, -half}, {half, half, half}}}; }

Pose at(double x, bool turned = false) {
  Pose pose;
  pose.center[0] = x;
  if (turned) {  // by 45 degrees about y
    pose.rotation[1] = std::sin(M_PI / 8);
    pose.rotation[3] = std::cos(M_PI / 8);
  }
  return pose;
}

TEST(ViewPick, RayPassesThroughImagePoint) {
  const Ray middle = rayThrough(ahead(), 0, 0), corner = rayThrough(ahead(), 0.5, -0.5);
  EXPECT_NEAR(middle.along[2], -1, 1e-12);
  // 90 degrees high: half a height is as far up as ahead.
  EXPECT_NEAR(corner.along[0], 1 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(corner.along[1], 1 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(corner.at(2)[2], 5 - 2 / std::sqrt(3.0), 1e-12);
}

TEST(ViewPick, PlacesPointsWhereTheirRaysPass) {
  const CameraView eye = {.eye = {3, 2, 5}, .target = {0, 0.5, 0}, .fov_y_deg = 38};
  const auto place = imagePlace(eye, rayThrough(eye, 0.3, -0.2).at(4));
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place)[0], 0.3, 1e-12);
  EXPECT_NEAR((*place)[1], -0.2, 1e-12);
  EXPECT_FALSE(imagePlace(eye, rayThrough(eye, 0.3, -0.2).at(-1))) << "behind the eye";
}

TEST(ViewPick, ReturnsNearestHit) {
  const Ray ray = rayThrough(ahead(), 0, 0);
  const Float3 balls[] = {{0, 0, -3}, {0.05f, 0, -1}, {0.2f, 0, 0}, {0, 0, 7}};  // the third is beside the ray, the last behind the eye
  const Double3 origin = {0, 0, 1};
  const auto fluid = pick(ray, balls, origin, 0.1, {}, {});
  ASSERT_TRUE(fluid);
  EXPECT_FALSE(fluid->solid);
  EXPECT_NEAR(fluid->distance, 5 - std::sqrt(0.1 * 0.1 - 0.05 * 0.05), 1e-6);
  const Solid solids[] = {box(1), {.shape = SphereShape{{0, 0, 0}, 0.5}}};
  const Pose poses[] = {at(3), at(0)};
  const auto solid = pick(ray, balls, origin, 0.1, solids, poses);
  ASSERT_TRUE(solid && solid->solid);
  EXPECT_EQ(*solid->solid, 1u);
  EXPECT_NEAR(solid->distance, 4.5, 1e-12);
  EXPECT_FALSE(pick(ray, {}, origin, 0.1, {}, {}));
  EXPECT_FALSE(pick(rayThrough(ahead(), -0.4, 0), balls, origin, 0.1, solids, poses));
}

TEST(ViewPick, HitsRotatedBoxAtEdge) {
  const Solid solids[] = {box(1)};
  const Pose straight[] = {at(0)}, turned[] = {at(0, true)};
  const Double3 origin = {0, 0, 0};
  const Ray ray = rayThrough(ahead(), 0, 0);
  EXPECT_NEAR(pick(ray, {}, origin, 0.1, solids, straight)->distance, 4, 1e-12);
  EXPECT_NEAR(pick(ray, {}, origin, 0.1, solids, turned)->distance, 5 - std::sqrt(2.0), 1e-9);
}

TEST(ViewPick, MissesBoxesAndPlanes) {
  const Ray ray = rayThrough(ahead(), 0, 0);
  EXPECT_NEAR(entry(ray, {-1, -1, -1}, {1, 1, 1}).value(), 4, 1e-12);
  EXPECT_EQ(entry(ray, {-9, -9, -9}, {9, 9, 9}).value(), 0) << "from inside";
  EXPECT_FALSE(entry(ray, {1, 1, -1}, {2, 2, 1}));
  EXPECT_FALSE(entry(ray, {-1, -1, 6}, {1, 1, 7})) << "behind";
  EXPECT_NEAR(hitPlane(ray, {7, 7, 1}, {0, 0, 1}).value(), 4, 1e-12);
  EXPECT_FALSE(hitPlane(ray, {0, 0, 9}, {0, 0, 1})) << "behind";
  EXPECT_FALSE(hitPlane(ray, {0, 1, 0}, {0, 1, 0})) << "along it";
}

}  // namespace
}  // namespace rill::view
