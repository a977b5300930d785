#include "view/orbit_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rill::view {
namespace {

CameraView someView() {
  CameraView view;
  const Double3 eye = {3, 2, 4}, target = {1, 0.5, -1};
  view.eye = eye;
  view.target = target;
  view.fov_y_deg = 35;
  return view;
}

void expectNear(const CameraView& a, const CameraView& b, double tolerance) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(a.eye[k], b.eye[k], tolerance);
    EXPECT_NEAR(a.target[k], b.target[k], tolerance);
  }
  EXPECT_EQ(a.fov_y_deg, b.fov_y_deg);
}

double distanceOf(const CameraView& v) { return std::hypot(v.eye[0] - v.target[0], v.eye[1] - v.target[1], v.eye[2] - v.target[2]); }

/// Where a point of the world is in the picture, in its heights from the middle, right and down.
std::array<double, 2> seen(const CameraView& view, const Double3& point) {
  const CameraBasis basis = cameraBasis(view);
  double right = 0, up = 0, forward = 0;
  for (int a = 0; a < 3; ++a) {
    const double d = point[a] - view.eye[a];
    right += d * basis.right[a];
    up += d * basis.up[a];
    forward += d * basis.forward[a];
  }
  const double heights = 1 / (2 * forward * std::tan(view.fov_y_deg * std::numbers::pi / 360));
  return {right * heights, -up * heights};
}

/// The point at the target's depth that is seen there.
Double3 pointAt(const CameraView& view, double right, double down) {
  const CameraBasis basis = cameraBasis(view);
  const double meters = 2 * distanceOf(view) * std::tan(view.fov_y_deg * std::numbers::pi / 360);
  Double3 point{};
  for (int a = 0; a < 3; ++a) point[a] = view.target[a] + meters * (right * basis.right[a] - down * basis.up[a]);
  return point;
}

TEST(OrbitCamera, ReturnsToHomeView) {
  OrbitCamera camera(someView());
  expectNear(camera.view(), someView(), 1e-12);
  EXPECT_FALSE(camera.moving());
  camera.orbit(0.4, -0.3);
  camera.pan(0.2, 0.1);
  camera.dolly(5, 0.3, -0.2);
  EXPECT_TRUE(camera.moving());
  camera.settle();
  EXPECT_GT(std::abs(camera.view().eye[0] - someView().eye[0]), 0.1);
  camera.home();
  camera.settle();
  expectNear(camera.view(), someView(), 1e-12);
}

TEST(OrbitCamera, MotionDoesNotDependOnFrameRate) {
  OrbitCamera fast(someView()), slow(someView());
  for (OrbitCamera* camera : {&fast, &slow}) {
    camera->orbit(0.3, 0.2);
    camera->dolly(3, 0.2, 0.1);
  }
  for (int k = 0; k < 100; ++k) fast.update(0.001);
  for (int k = 0; k < 4; ++k) slow.update(0.025);
  expectNear(fast.view(), slow.view(), 1e-9);
  EXPECT_TRUE(fast.moving());
  for (int k = 0; k < 100; ++k) fast.update(0.02);
  EXPECT_FALSE(fast.moving()) << "it arrives";
}

TEST(OrbitCamera, DoesNotPassPoles) {
  OrbitCamera camera(someView());
  for (int k = 0; k < 50; ++k) {
    camera.orbit(0.05, 0.2);
    camera.settle();
    const CameraBasis basis = cameraBasis(camera.view());
    EXPECT_GT(basis.up[1], 0) << "up stays up";
  }
  EXPECT_GT(camera.view().eye[1] - camera.view().target[1], 0.99 * distanceOf(camera.view())) << "it got to the top";
}

TEST(OrbitCamera, DollyKeepsPointUnderPointer) {
  OrbitCamera camera(someView());
  const auto point = pointAt(camera.view(), 0.4, -0.25);
  const double before = distanceOf(camera.view());
  camera.dolly(6, 0.4, -0.25);
  for (int k = 0; k < 60; ++k) {
    camera.update(1.0 / 60);
    const auto at = seen(camera.view(), point);
    EXPECT_NEAR(at[0], 0.4, 1e-9);
    EXPECT_NEAR(at[1], -0.25, 1e-9);
  }
  EXPECT_LT(distanceOf(camera.view()), 0.5 * before);
}

TEST(OrbitCamera, PanFollowsPointerAtTargetDepth) {
  OrbitCamera camera(someView());
  const auto point = pointAt(camera.view(), 0, 0);
  camera.pan(0.3, -0.2);
  camera.settle();
  const auto at = seen(camera.view(), point);
  EXPECT_NEAR(at[0], 0.3, 1e-9);
  EXPECT_NEAR(at[1], -0.2, 1e-9);
}

TEST(OrbitCamera, LooksAlongAxes) {
  OrbitCamera camera(someView());
  const struct {
    AxisView view;
    Double3 forward;
  } rows[] = {{AxisView::Front, {0, 0, -1}}, {AxisView::Back, {0, 0, 1}}, {AxisView::Right, {-1, 0, 0}},
              {AxisView::Left, {1, 0, 0}},   {AxisView::Top, {0, -1, 0}}, {AxisView::Bottom, {0, 1, 0}}};
  for (const auto& row : rows) {
    camera.look(row.view);
    camera.settle();
    const CameraBasis basis = cameraBasis(camera.view());
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(basis.forward[a], row.forward[a], 2e-3);
  }
}

TEST(OrbitCamera, RotatesInShorterDirection) {
  OrbitCamera camera(someView());
  camera.look(AxisView::Back);
  camera.settle();
  for (int k = 0; k < 5; ++k) camera.orbit(1, 0);  // two and a half turns: to the front
  camera.settle();
  camera.look(AxisView::Front);
  camera.update(0.01);
  EXPECT_GT(camera.view().eye[2] - camera.view().target[2], 0.99 * distanceOf(camera.view()));
}

TEST(OrbitCamera, ReframeKeepsMovedCamera) {
  CameraView wide = someView();
  wide.fov_y_deg = 60;
  OrbitCamera untouched(someView()), moved(someView());
  moved.pan(0.5, 0);
  moved.settle();
  const CameraView before = moved.view();
  untouched.reframe(wide);
  moved.reframe(wide);
  expectNear(untouched.view(), wide, 1e-12);
  for (int a = 0; a < 3; ++a) EXPECT_EQ(moved.view().target[a], before.target[a]);
  EXPECT_EQ(moved.view().fov_y_deg, 60);
}

}  // namespace
}  // namespace rill::view
