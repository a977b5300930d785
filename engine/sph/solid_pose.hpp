#pragma once
// Pose of a solid at a time, and signed distances to its surface.
#include "rill/scene.hpp"

namespace rill {

/// A solid at a time, in scene coordinates, or relative to an origin that the caller subtracts from `center`.
struct SolidPose {
  bool sphere = false;                ///< else a box
  double center[3] = {0, 0, 0};       ///< m
  double half[3] = {0, 0, 0};         ///< m, half extents of a box; the radius of a sphere in each
  double rotation[4] = {0, 0, 0, 1};  ///< unit quaternion x y z w, from the solid's frame to the scene's
  double velocity[3] = {0, 0, 0};     ///< m/s
  double friction = 0, restitution = 0;
};

/// Translation (m) by the keyframes at time `t` (s), relative to the initial pose: linear between keyframes, constant outside, 0 without
/// keyframes.
void solidTranslation(const Solid& solid, double t, double translation[3]);

/// The pose at `t` (s). The velocity is the slope of the keyframes, right-continuous; 0 before the first and after the last.
SolidPose solidPose(const Solid& solid, double t);

/// The pose at `t + dt` with the mean velocity over [t, t + dt], also across keyframes. dt: s, > 0.
SolidPose solidPose(const Solid& solid, double t, double dt);

/// Transforms a point `x` (m, in the frame of `pose.center`) to the solid's frame, and a direction back.
void toSolid(const SolidPose& pose, const double x[3], double local[3]);
void fromSolid(const SolidPose& pose, const double localDirection[3], double direction[3]);

/// Signed distance to a surface and its gradient.
struct SurfacePoint {
  double distance = 0;           ///< m, negative inside
  double normal[3] = {0, 1, 0};  ///< unit, outward
};

/// Distance from a sphere centered on 0. At the center the normal is +y.
SurfacePoint sphereSurface(const double local[3], double radius);

/// Distance from a box centered on 0, in its frame. Outside: to the closest point, so edges are round. Inside: to the closest face; ties
/// take the first of x, y, z, and the positive side at coordinate 0.
SurfacePoint boxSurface(const double local[3], const double half[3]);

/// Distance of `x` from the solid; `x` and the normal are in the frame of `pose.center`.
SurfacePoint solidSurface(const SolidPose& pose, const double x[3]);

}  // namespace rill
