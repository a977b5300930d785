#include "shape/pose.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/vector_math.hpp"

namespace rill {
namespace {

/// Rotates v by the unit quaternion q (sign 1) or its conjugate (sign -1).
Double3 rotate(const Quaternion& q, double sign, const Double3& v) {
  const double x = sign * q[0], y = sign * q[1], z = sign * q[2], w = q[3];
  const Double3 t = {2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])};
  const Double3 u = {y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]};
  return {v[0] + w * t[0] + u[0], v[1] + w * t[1] + u[1], v[2] + w * t[2] + u[2]};
}

Double3 over(const Double3& v, double divisor) { return {v[0] / divisor, v[1] / divisor, v[2] / divisor}; }

/// The rotation b, then a.
Quaternion composed(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + b[3] * a[0] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] + b[3] * a[1] + a[2] * b[0] - a[0] * b[2],
          a[3] * b[2] + b[3] * a[2] + a[0] * b[1] - a[1] * b[0], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

double lengthOf(const Double3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// The rotation by a rotation vector, rad.
Quaternion rotationBy(const Double3& turn) {
  const double angle = lengthOf(turn), scale = angle > 0 ? std::sin(angle / 2) / angle : 0;
  return {scale * turn[0], scale * turn[1], scale * turn[2], std::cos(angle / 2)};
}

/// Displacement from the initial pose.
struct Displacement {
  Double3 translation = {};
  Quaternion rotation = {0, 0, 0, 1};
  Double3 velocity = {}, angularVelocity = {};
};

Displacement displacementAt(const std::vector<Keyframe>& motion, double t) {
  if (motion.empty()) return {};
  const auto next = std::upper_bound(motion.begin(), motion.end(), t, [](double time, const Keyframe& key) { return time < key.at; });
  const Keyframe& last = next == motion.begin() ? *next : *std::prev(next);
  Displacement out{.translation = last.translate, .rotation = last.rotate};
  if (next == motion.begin() || next == motion.end()) return out;
  const double span = next->at - last.at, since = t - last.at;
  out.velocity = over(minus(next->translate, out.translation), span);
  out.angularVelocity = over(turnBetween(out.rotation, next->rotate), span);
  for (size_t a = 0; a < 3; ++a) out.translation[a] += since * out.velocity[a];
  out.rotation = turned(out.rotation, since, out.angularVelocity);
  return out;
}

/// Of a box with these half extents.
Double3 turnedExtents(const Double3& half, const Pose& pose) {
  Double3 extents = {};
  for (size_t own = 0; own < 3; ++own) {
    Double3 axis = {};
    axis[own] = half[own];
    axis = toScene(pose, axis);
    for (size_t a = 0; a < 3; ++a) extents[a] += std::abs(axis[a]);
  }
  return extents;
}

}  // namespace

Double3 turnBetween(const Quaternion& from, const Quaternion& to) {
  Quaternion by = composed(to, {-from[0], -from[1], -from[2], from[3]});
  if (by[3] < 0) by = {-by[0], -by[1], -by[2], -by[3]};
  const Double3 axis = {by[0], by[1], by[2]};
  const double sine = lengthOf(axis), scale = sine > 0 ? 2 * std::atan2(sine, by[3]) / sine : 0;
  return {scale * axis[0], scale * axis[1], scale * axis[2]};
}

Quaternion turned(const Quaternion& q, double share, const Double3& turn) {
  return composed(rotationBy({share * turn[0], share * turn[1], share * turn[2]}), q);
}

Quaternion normalized(const Quaternion& q) {
  const double length = std::hypot(std::hypot(q.x, q.y, q.z), q.w);
  return {q.x / length, q.y / length, q.z / length, q.w / length};
}

Pose keyframedPose(const std::vector<Keyframe>& motion, const Double3& center, const Quaternion& rotation, double t) {
  const Displacement by = displacementAt(motion, t);
  Pose pose{.center = by.translation,
            .rotation = composed(by.rotation, rotation),
            .velocity = by.velocity,
            .angularVelocity = by.angularVelocity};
  for (size_t a = 0; a < 3; ++a) pose.center[a] += center[a];
  return pose;
}

Pose solidPose(const Solid& solid, double t) { return keyframedPose(solid.motion, centerOf(solid), solid.rotation, t); }

Pose solidPose(const Solid& solid, double t, double dt) {
  const Displacement from = displacementAt(solid.motion, t), to = displacementAt(solid.motion, t + dt);
  Pose pose = solidPose(solid, t + dt);
  pose.velocity = over(minus(to.translation, from.translation), dt);
  pose.angularVelocity = over(turnBetween(from.rotation, to.rotation), dt);
  return pose;
}

Double3 toScene(const Pose& pose, const Double3& local) { return rotate(pose.rotation, 1, local); }

Double3 toSolid(const Pose& pose, const Double3& direction) { return rotate(pose.rotation, -1, direction); }

Double3 localPoint(const Pose& pose, const Double3& x) { return toSolid(pose, minus(x, pose.center)); }

Double3 velocityAt(const Pose& pose, const Double3& x) {
  return along(pose.velocity, 1, cross(pose.angularVelocity, minus(x, pose.center)));
}

SurfacePoint surfaceAt(const Shape& shape, const Pose& pose, const Double3& x) {
  const SurfacePoint local = surfaceAt(shape, localPoint(pose, x));
  return {local.distance, toScene(pose, local.normal)};
}

SceneBox sceneBox(const Shape& shape, const Pose& pose) {
  const Double3 half = std::holds_alternative<SphereShape>(shape) ? halfExtents(shape) : turnedExtents(halfExtents(shape), pose);
  const Double3 middle = toScene(pose, middleOf(shape));
  SceneBox bounds;
  for (size_t a = 0; a < 3; ++a) {
    bounds.low[a] = pose.center[a] + middle[a] - half[a];
    bounds.high[a] = pose.center[a] + middle[a] + half[a];
  }
  return bounds;
}

}  // namespace rill
