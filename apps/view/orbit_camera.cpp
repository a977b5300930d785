#include "view/orbit_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill::view {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPole = 0.5 * kPi - 1e-3;          // keeps the eye off the vertical, where yaw is undefined
constexpr double kTimeConstant = 0.06;              // s; time constant of the motion
constexpr double kWheelFactor = 0.88;               // factor of the distance per step of the wheel
constexpr double kNearest = 1e-4, kFarthest = 1e6;  // m

}  // namespace

OrbitCamera::OrbitCamera(const CameraView& view) { home(view); }

void OrbitCamera::home(const CameraView& view) {
  home_ = view;
  home();
  settle();
}

OrbitCamera::Pose OrbitCamera::pose(const CameraView& view) {
  Double3 away{};
  for (size_t a = 0; a < 3; ++a) away[a] = view.eye[a] - view.target[a];
  Pose pose;
  pose.distance = std::clamp(std::hypot(away[0], away[1], away[2]), kNearest, kFarthest);
  pose.target = view.target;
  pose.pitch = std::clamp(std::asin(std::clamp(away[1] / pose.distance, -1.0, 1.0)), -kPole, kPole);
  pose.yaw = std::atan2(away[0], away[2]);
  return pose;
}

void OrbitCamera::home() {
  goal_ = pose(home_);
  unwrapYaw();
}

void OrbitCamera::unwrapYaw() { now_.yaw += 2 * kPi * std::round((goal_.yaw - now_.yaw) / (2 * kPi)); }

void OrbitCamera::reframe(const CameraView& view) {
  const bool atHome = goal_.target == pose(home_).target && goal_.distance == pose(home_).distance;
  home_ = view;
  if (atHome) {  // not moved by input: keep the scene framed
    goal_.target = pose(home_).target;
    goal_.distance = pose(home_).distance;
    settle();
  }
}

void OrbitCamera::orbit(double right, double down) {
  goal_.yaw -= kPi * right;
  goal_.pitch = std::clamp(goal_.pitch + kPi * down, -kPole, kPole);
}

double OrbitCamera::metersPerHeight() const { return 2 * goal_.distance * std::tan(home_.fov_y_deg * kPi / 360); }

void OrbitCamera::pan(double right, double down) {
  const CameraBasis basis = cameraBasis(viewOf(goal_, home_.fov_y_deg));
  for (int a = 0; a < 3; ++a) goal_.target[a] -= metersPerHeight() * (right * basis.right[a] - down * basis.up[a]);
}

void OrbitCamera::dolly(double steps, double right, double down) {
  const double distance = std::clamp(goal_.distance * std::pow(kWheelFactor, steps), kNearest, kFarthest),
               ratio = distance / goal_.distance;
  const CameraBasis basis = cameraBasis(viewOf(goal_, home_.fov_y_deg));
  for (int a = 0; a < 3; ++a) goal_.target[a] += (1 - ratio) * metersPerHeight() * (right * basis.right[a] - down * basis.up[a]);
  goal_.distance = distance;
}

void OrbitCamera::look(AxisView axis) {
  switch (axis) {
    case AxisView::Front:
      goal_.yaw = 0, goal_.pitch = 0;
      break;
    case AxisView::Back:
      goal_.yaw = kPi, goal_.pitch = 0;
      break;
    case AxisView::Right:
      goal_.yaw = 0.5 * kPi, goal_.pitch = 0;
      break;
    case AxisView::Left:
      goal_.yaw = -0.5 * kPi, goal_.pitch = 0;
      break;
    case AxisView::Top:
      goal_.yaw = 0, goal_.pitch = kPole;
      break;
    case AxisView::Bottom:
      goal_.yaw = 0, goal_.pitch = -kPole;
      break;
  }
  unwrapYaw();
}

void OrbitCamera::update(double seconds) {
  if (!moving()) return settle();
  const double fraction = 1 - std::exp(-std::max(seconds, 0.0) / kTimeConstant);
  // Target and distance move by the same fraction, so that the point of a dolly stays under the pointer.
  for (int a = 0; a < 3; ++a) now_.target[a] += fraction * (goal_.target[a] - now_.target[a]);
  now_.distance += fraction * (goal_.distance - now_.distance);
  now_.yaw += fraction * (goal_.yaw - now_.yaw);
  now_.pitch += fraction * (goal_.pitch - now_.pitch);
}

bool OrbitCamera::moving() const {
  constexpr double kVisible = 1e-4;  // radians, or relative to the distance: a tenth of a pixel
  double offset = std::abs(goal_.distance - now_.distance);
  for (int a = 0; a < 3; ++a) offset = std::max(offset, std::abs(goal_.target[a] - now_.target[a]));
  return offset > kVisible * goal_.distance || std::abs(goal_.yaw - now_.yaw) > kVisible || std::abs(goal_.pitch - now_.pitch) > kVisible;
}

CameraView OrbitCamera::viewOf(const Pose& pose, double fov_y_deg) {
  const Double3 direction = {std::cos(pose.pitch) * std::sin(pose.yaw), std::sin(pose.pitch), std::cos(pose.pitch) * std::cos(pose.yaw)};
  CameraView view;
  view.fov_y_deg = fov_y_deg;
  for (int a = 0; a < 3; ++a) {
    view.target[a] = pose.target[a];
    view.eye[a] = pose.target[a] + pose.distance * direction[a];
  }
  return view;
}

CameraView OrbitCamera::view() const { return viewOf(now_, home_.fov_y_deg); }

}  // namespace rill::view
