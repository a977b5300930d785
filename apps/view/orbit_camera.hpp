#pragma once
#include <array>

#include "views/camera.hpp"

namespace rill::view {

enum class AxisView { Front, Back, Right, Left, Top, Bottom };

/// A camera that goes around a point, y up. Hands move where it is to go; where it is follows smoothly, at any frame rate. It never turns
/// over its poles. Lengths on the picture are in its heights, so that a hand does the same in a window of any size.
class OrbitCamera {
 public:
  explicit OrbitCamera(const CameraView& home);

  /// The pointer was dragged by so much, right and down: one height is half a turn.
  void orbit(double right, double down);
  /// What lies at the target's depth follows the pointer.
  void pan(double right, double down);
  /// Nearer by `steps` of the wheel (farther where negative), towards what lies at the target's depth under the pointer, which is so far
  /// right of the picture's middle and below it.
  void dolly(double steps, double right, double down);
  void home();                           ///< back to the start
  void home(const CameraView& view);     ///< to another scene's, at once
  void reframe(const CameraView& view);  ///< what home() goes back to, and the field of view, in a picture of another shape
  void look(AxisView axis);              ///< along an axis, at the same target and distance
  void update(double seconds);           ///< goes on towards where hands have moved it
  void settle() { now_ = goal_; }        ///< is there at once
  bool moving() const;                   ///< whether update() would still change the picture
  CameraView view() const;

 private:
  struct Pose {
    std::array<double, 3> target{};  // m
    double distance = 1;             // m
    double yaw = 0, pitch = 0;       // radians; 0: looking along -z. pitch: up, of the eye over the target
  };
  static Pose pose(const CameraView& view);
  void takeShortWay();  ///< of two ways around
  static CameraView viewOf(const Pose& pose, double fov_y_deg);
  double metersAHeight() const;  // at the target's depth

  CameraView home_;
  Pose goal_, now_;
};

}  // namespace rill::view
