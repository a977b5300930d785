#include "sph/solid_pose.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rill {
namespace {

/// Rotates v by the unit quaternion q (sign 1) or its conjugate (sign -1).
void rotate(const double q[4], double sign, const double v[3], double out[3]) {
  const double x = sign * q[0], y = sign * q[1], z = sign * q[2], w = q[3];
  const double t[3] = {2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])};
  const double u[3] = {y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]};
  for (int a = 0; a < 3; ++a) out[a] = v[a] + w * t[a] + u[a];
}

SolidPose poseAt(const Solid& solid, double t) {
  SolidPose pose;
  solidTranslation(solid, t, pose.center);
  pose.sphere = solid.sphere.has_value();
  for (int a = 0; a < 3; ++a) {
    if (pose.sphere) {
      pose.center[a] += solid.sphere->center[a];
      pose.half[a] = solid.sphere->radius;
    } else if (solid.box) {
      pose.center[a] += (solid.box->min[a] + solid.box->max[a]) / 2;
      pose.half[a] = (solid.box->max[a] - solid.box->min[a]) / 2;
    }
  }
  std::copy(std::begin(solid.rotation), std::end(solid.rotation), pose.rotation);
  pose.friction = solid.friction;
  pose.restitution = solid.restitution;
  return pose;
}

/// The first keyframe after t.
auto nextKeyframe(const Solid& solid, double t) {
  return std::upper_bound(solid.motion.begin(), solid.motion.end(), t, [](double time, const Keyframe& key) { return time < key.at; });
}

}  // namespace

void solidTranslation(const Solid& solid, double t, double translation[3]) {
  const auto next = nextKeyframe(solid, t);
  for (int a = 0; a < 3; ++a) {
    if (solid.motion.empty()) {
      translation[a] = 0;
    } else if (next == solid.motion.begin()) {
      translation[a] = next->translate[a];
    } else if (next == solid.motion.end()) {
      translation[a] = std::prev(next)->translate[a];
    } else {
      const Keyframe& last = *std::prev(next);
      const double fraction = (t - last.at) / (next->at - last.at);
      translation[a] = last.translate[a] + fraction * (next->translate[a] - last.translate[a]);
    }
  }
}

SolidPose solidPose(const Solid& solid, double t) {
  SolidPose pose = poseAt(solid, t);
  const auto next = nextKeyframe(solid, t);
  if (next != solid.motion.begin() && next != solid.motion.end()) {
    const Keyframe& last = *std::prev(next);
    for (int a = 0; a < 3; ++a) pose.velocity[a] = (next->translate[a] - last.translate[a]) / (next->at - last.at);
  }
  return pose;
}

SolidPose solidPose(const Solid& solid, double t, double dt) {
  SolidPose pose = poseAt(solid, t + dt);
  double from[3], to[3];
  solidTranslation(solid, t, from);
  solidTranslation(solid, t + dt, to);
  for (int a = 0; a < 3; ++a) pose.velocity[a] = (to[a] - from[a]) / dt;
  return pose;
}

void toSolid(const SolidPose& pose, const double x[3], double local[3]) {
  const double offset[3] = {x[0] - pose.center[0], x[1] - pose.center[1], x[2] - pose.center[2]};
  rotate(pose.rotation, -1, offset, local);
}

void fromSolid(const SolidPose& pose, const double localDirection[3], double direction[3]) {
  rotate(pose.rotation, 1, localDirection, direction);
}

SurfacePoint sphereSurface(const double local[3], double radius) {
  SurfacePoint point;
  const double r = std::sqrt(local[0] * local[0] + local[1] * local[1] + local[2] * local[2]);
  point.distance = r - radius;
  if (r > 0)
    for (int a = 0; a < 3; ++a) point.normal[a] = local[a] / r;
  return point;
}

SurfacePoint boxSurface(const double local[3], const double half[3]) {
  double beyond[3], outside = 0;
  int nearest = 0;
  for (int a = 0; a < 3; ++a) {
    beyond[a] = std::abs(local[a]) - half[a];
    outside += std::max(beyond[a], 0.0) * std::max(beyond[a], 0.0);
    if (beyond[a] > beyond[nearest]) nearest = a;
  }
  SurfacePoint point;
  const auto side = [&](int a) { return local[a] < 0 ? -1.0 : 1.0; };
  if (outside > 0) {
    point.distance = std::sqrt(outside);
    for (int a = 0; a < 3; ++a) point.normal[a] = side(a) * std::max(beyond[a], 0.0) / point.distance;
  } else {
    point.distance = beyond[nearest];
    for (int a = 0; a < 3; ++a) point.normal[a] = a == nearest ? side(a) : 0;
  }
  return point;
}

SurfacePoint solidSurface(const SolidPose& pose, const double x[3]) {
  double local[3];
  toSolid(pose, x, local);
  SurfacePoint point = pose.sphere ? sphereSurface(local, pose.half[0]) : boxSurface(local, pose.half);
  double normal[3];
  fromSolid(pose, point.normal, normal);
  std::copy(std::begin(normal), std::end(normal), point.normal);
  return point;
}

}  // namespace rill
