#include "view/gravity_tilt.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rill::view {
namespace {

constexpr Double3 kDown{0, -9.81, 0};

CameraView from(double x, double y, double z) {
  CameraView view;
  view.eye[0] = x;
  view.eye[1] = y;
  view.eye[2] = z;
  return view;
}

double length(const Double3& v) { return std::hypot(v[0], v[1], v[2]); }

TEST(GravityTilt, FollowsImageDirections) {
  const CameraView front = from(0, 1, 3), right = from(3, 1, 0);
  EXPECT_GT(tilted(kDown, front, Tilt::Right, 10)[0], 1.6);
  EXPECT_LT(tilted(kDown, front, Tilt::Left, 10)[0], -1.6);
  EXPECT_LT(tilted(kDown, front, Tilt::Away, 10)[2], -1.6) << "the eye looks along -z";
  EXPECT_GT(tilted(kDown, front, Tilt::Towards, 10)[2], 1.6);
  EXPECT_LT(tilted(kDown, right, Tilt::Right, 10)[2], -1.6) << "seen from +x, -z is right";
  EXPECT_LT(tilted(kDown, right, Tilt::Away, 10)[0], -1.6);
}

TEST(GravityTilt, KeepsMagnitudeAndStopsAtHorizontal) {
  const CameraView eye = from(1, 2, 3);
  auto g = kDown;
  for (int k = 0; k < 4; ++k) g = tilted(g, eye, Tilt::Left, 10);
  EXPECT_NEAR(length(g), 9.81, 1e-9);
  EXPECT_NEAR(g[1], -9.81 * std::cos(40 * 3.14159265358979 / 180), 1e-6);
  for (int k = 0; k < 4; ++k) g = tilted(g, eye, Tilt::Right, 10);
  for (size_t a = 0; a < 3; ++a) EXPECT_NEAR(g[a], kDown[a], 1e-4);
  for (int k = 0; k < 20; ++k) g = tilted(g, eye, Tilt::Left, 10);
  EXPECT_NEAR(g[1], 0, 1e-6);
  EXPECT_NEAR(length(g), 9.81, 1e-6);
  EXPECT_EQ(length(tilted({0, 0, 0}, eye, Tilt::Left, 10)), 0);
}

}  // namespace
}  // namespace rill::view
