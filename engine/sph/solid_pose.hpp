#pragma once
// Where a solid is at a time, and the nearest point of its surface.
#include "rill/scene.hpp"

namespace rill {

/// A solid at an instant, in scene coordinates or relative to any origin that the caller takes off `center`.
struct SolidPose {
  bool sphere = false;                ///< else a box
  double center[3] = {0, 0, 0};       ///< m
  double half[3] = {0, 0, 0};         ///< m, half extents of a box; the radius in each of a sphere
  double rotation[4] = {0, 0, 0, 1};  ///< unit quaternion x y z w, from the solid's frame to the scene's
  double velocity[3] = {0, 0, 0};     ///< m/s
  double friction = 0, restitution = 0;
};

/// What the keyframes add to the shape's own place at time `t` (s): linear between, the first held before it, the last after it, 0 without
/// any. m.
void solidTranslation(const Solid& solid, double t, double translation[3]);

/// The pose at `t`, with the slope of the keyframes there as velocity: from a keyframe on, that of the piece that starts there. 0 before
/// the first and from the last on.
SolidPose solidPose(const Solid& solid, double t);

/// The pose at `t + dt` with the mean velocity over [t, t + dt]: consistent with positions over a step that spans a keyframe. dt > 0.
SolidPose solidPose(const Solid& solid, double t, double dt);

/// `x` (m, in the frame of `pose.center`) seen from the solid's frame, and back for directions.
void toSolid(const SolidPose& pose, const double x[3], double local[3]);
void fromSolid(const SolidPose& pose, const double localDirection[3], double direction[3]);

/// The signed distance to a surface and the direction in which it grows.
struct SurfacePoint {
  double distance = 0;           ///< m, negative inside
  double normal[3] = {0, 1, 0};  ///< unit, outward
};

/// Of a ball about 0: at its very center the normal is +y.
SurfacePoint sphereSurface(const double local[3], double radius);

/// Of a box about 0, in its frame. Outside: to the nearest point of the box, so that an edge is round. Inside: the face of least depth, the
/// first of x, y, z among equals, the positive side where the coordinate is not negative.
SurfacePoint boxSurface(const double local[3], const double half[3]);

/// Of the solid, from `x` in the frame of `pose.center`; the normal in that frame.
SurfacePoint solidSurface(const SolidPose& pose, const double x[3]);

}  // namespace rill
