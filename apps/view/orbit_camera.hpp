#pragma once
#include <array>

#include "views/camera.hpp"

namespace rill::view {

enum class AxisView { Front, Back, Right, Left, Top, Bottom };

/// A camera that orbits a target, y up. Input moves its goal, and the camera follows smoothly at any frame rate. It does not
/// rotate past the poles. Lengths in the image are in image heights, so that input does not depend on the window's size.
class OrbitCamera {
 public:
  explicit OrbitCamera(const CameraView& home);

  /// Rotates by a drag of the pointer, right and down: one image height is half a turn.
  void orbit(double right, double down);
  /// Moves the target so that points at its depth follow the pointer.
  void pan(double right, double down);
  /// Moves nearer by `steps` of the wheel (farther if negative), towards the point at the target's depth under the pointer,
  /// which is `right` and `down` of the image's center.
  void dolly(double steps, double right, double down);
  void home();                           ///< back to the home view
  void home(const CameraView& view);     ///< sets the home view and goes there at once
  void reframe(const CameraView& view);  ///< changes the home view and the field of view
  void look(AxisView axis);              ///< looks along an axis, with the same target and distance
  void update(double seconds);           ///< moves towards the goal
  void settle() { now_ = goal_; }        ///< moves to the goal at once
  bool moving() const;                   ///< true where update() would change the image
  CameraView view() const;

 private:
  struct Pose {
    Double3 target{};           // m
    double distance = 1;        // m
    double yaw = 0, pitch = 0;  // radians; yaw 0 looks along -z, pitch is the elevation of the eye
  };
  static Pose pose(const CameraView& view);
  void unwrapYaw();  ///< chooses the shorter direction of rotation
  static CameraView viewOf(const Pose& pose, double fov_y_deg);
  double metersPerHeight() const;  // of the image, at the target's depth

  CameraView home_;
  Pose goal_, now_;
};

}  // namespace rill::view
