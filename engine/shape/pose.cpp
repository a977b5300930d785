#include "shape/pose.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rill {
namespace {

/// Rotates v by the unit quaternion q (sign 1) or its conjugate (sign -1).
Vec3 rotate(const std::array<double, 4>& q, double sign, const Vec3& v) {
  const double x = sign * q[0], y = sign * q[1], z = sign * q[2], w = q[3];
  const Vec3 t = {2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])};
  const Vec3 u = {y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]};
  return {v[0] + w * t[0] + u[0], v[1] + w * t[1] + u[1], v[2] + w * t[2] + u[2]};
}

/// The first keyframe after t.
auto nextKeyframe(const Solid& solid, double t) {
  return std::upper_bound(solid.motion.begin(), solid.motion.end(), t, [](double time, const Keyframe& key) { return time < key.at; });
}

Pose restingPose(const Solid& solid, double t) {
  Pose pose{.center = solidTranslation(solid, t), .rotation = std::to_array(solid.rotation)};
  const Vec3 center = centerOf(solid.shape);
  for (size_t a = 0; a < 3; ++a) pose.center[a] += center[a];
  return pose;
}

}  // namespace

Vec3 solidTranslation(const Solid& solid, double t) {
  const auto next = nextKeyframe(solid, t);
  if (solid.motion.empty()) return {};
  if (next == solid.motion.begin()) return std::to_array(next->translate);
  const Keyframe& last = *std::prev(next);
  Vec3 translation = std::to_array(last.translate);
  if (next == solid.motion.end()) return translation;
  const double fraction = (t - last.at) / (next->at - last.at);
  for (size_t a = 0; a < 3; ++a) translation[a] += fraction * (next->translate[a] - last.translate[a]);
  return translation;
}

Pose solidPose(const Solid& solid, double t) {
  Pose pose = restingPose(solid, t);
  const auto next = nextKeyframe(solid, t);
  if (next != solid.motion.begin() && next != solid.motion.end()) {
    const Keyframe& last = *std::prev(next);
    for (size_t a = 0; a < 3; ++a) pose.velocity[a] = (next->translate[a] - last.translate[a]) / (next->at - last.at);
  }
  return pose;
}

Pose solidPose(const Solid& solid, double t, double dt) {
  Pose pose = restingPose(solid, t + dt);
  const Vec3 from = solidTranslation(solid, t), to = solidTranslation(solid, t + dt);
  for (size_t a = 0; a < 3; ++a) pose.velocity[a] = (to[a] - from[a]) / dt;
  return pose;
}

Vec3 toScene(const Pose& pose, const Vec3& local) { return rotate(pose.rotation, 1, local); }

Vec3 toSolid(const Pose& pose, const Vec3& direction) { return rotate(pose.rotation, -1, direction); }

Vec3 localPoint(const Pose& pose, const Vec3& x) {
  return toSolid(pose, {x[0] - pose.center[0], x[1] - pose.center[1], x[2] - pose.center[2]});
}

Vec3 velocityAt(const Pose& pose, const Vec3& x) {
  const Vec3& w = pose.angularVelocity;
  const Vec3 r = {x[0] - pose.center[0], x[1] - pose.center[1], x[2] - pose.center[2]};
  return {pose.velocity[0] + w[1] * r[2] - w[2] * r[1], pose.velocity[1] + w[2] * r[0] - w[0] * r[2],
          pose.velocity[2] + w[0] * r[1] - w[1] * r[0]};
}

SurfacePoint surfaceAt(const Shape& shape, const Pose& pose, const Vec3& x) {
  const SurfacePoint local = surfaceAt(shape, localPoint(pose, x));
  return {local.distance, toScene(pose, local.normal)};
}

Vec3 sceneExtents(const Shape& shape, const Pose& pose) {
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) return halfExtents(*sphere);
  const Vec3 half = halfExtents(shape);
  Vec3 extents = {};
  for (size_t own = 0; own < 3; ++own) {
    Vec3 axis = {};
    axis[own] = half[own];
    axis = toScene(pose, axis);
    for (size_t a = 0; a < 3; ++a) extents[a] += std::abs(axis[a]);
  }
  return extents;
}

}  // namespace rill
