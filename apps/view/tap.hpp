#pragma once
// A tap that follows the pointer: an emitter that is added to the scene when it is opened first.
#include "view/pick.hpp"
#include "view/session.hpp"

namespace rill::view {

class Tap {
 public:
  /// Pours `flow` m^3/s (0: defaultFlow()) of the scene's `fluid` (empty: the first) from above what the ray hits first, until close().
  /// BadInput where it misses the scene.
  Expected<void> open(Session& session, const Ray& ray, double flow, const std::string& fluid = {});
  /// Moves it to the ray, in the plane parallel to the image through the point that it pours at.
  void move(Session& session, const CameraView& eye, const Ray& ray);
  void close(Session& session);
  bool isOpen() const { return open_; }
  /// Call after the scene was restarted.
  void reset() { open_ = false; }

  static double defaultFlow(const Session& session);  ///< m^3/s
  static double radius(const Session& session);       ///< m, of the mouth

 private:
  void pour(Session& session);

  bool open_ = false;
  double flow_ = 0;
  Double3 point_{}, down_{};  // where it pours at; unit vector
};

}  // namespace rill::view
