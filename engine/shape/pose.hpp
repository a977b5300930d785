#pragma once
// Where a solid is and how it moves; from its keyframes.
#include "shape/shape.hpp"

namespace rill {

/// A position, an orientation and their rates of change, in scene coordinates or relative to an origin that the caller subtracts from
/// `center`. The device's record of it is in shaders/shared/solid_records.h.
struct Pose {
  Double3 center = {0, 0, 0};           ///< m
  Quaternion rotation = {0, 0, 0, 1};   ///< unit quaternion x y z w, from the solid's frame to the scene's
  Double3 velocity = {0, 0, 0};         ///< of the center, m/s
  Double3 angularVelocity = {0, 0, 0};  ///< rad/s, in the scene's frame
};

/// Rotation vector (rad) that leads from one unit quaternion to another the shorter way, in the scene's frame.
Double3 turnBetween(const Quaternion& from, const Quaternion& to);

/// The rotation q, then `share` of a rotation vector (rad, in the scene's frame).
Quaternion turned(const Quaternion& q, double share, const Double3& turn);

/// Of unit length; `q` is finite and not zero.
Quaternion normalized(const Quaternion& q);

/// The pose at `t` (s) of what is at `center` (m) with `rotation` before any motion: linear and spherical linear between keyframes,
/// constant outside. The velocities are the slopes of the keyframes, right-continuous; 0 before the first and after the last.
Pose keyframedPose(const std::vector<Keyframe>& motion, const Double3& center, const Quaternion& rotation, double t);

/// The pose of a solid at `t` (s).
Pose solidPose(const Solid& solid, double t);

/// The pose at `t + dt` with the mean velocities over [t, t + dt], also across keyframes. dt: s, > 0.
Pose solidPose(const Solid& solid, double t, double dt);

/// A direction in the solid's frame, in the scene's.
Double3 toScene(const Pose& pose, const Double3& local);
/// A direction in the scene, in the solid's frame.
Double3 toSolid(const Pose& pose, const Double3& direction);
/// A point (m, in the frame of `pose.center`), in the solid's frame.
Double3 localPoint(const Pose& pose, const Double3& x);

/// Velocity of the solid's point at `x` (m, in the frame of `pose.center`), m/s.
Double3 velocityAt(const Pose& pose, const Double3& x);

/// Distance of `x` from a shape with this pose; `x` and the normal are in the frame of `pose.center`.
SurfacePoint surfaceAt(const Shape& shape, const Pose& pose, const Double3& x);

/// The bounding box along the axes of the scene of a shape with this pose, in the frame of `pose.center`, m.
struct SceneBox {
  Double3 low = {}, high = {};
};
SceneBox sceneBox(const Shape& shape, const Pose& pose);

}  // namespace rill
