#pragma once
// Mouse input over the image: moves the camera, interacts with the fluid and the solids.
#include <functional>

#include "view/input.hpp"
#include "view/layout.hpp"
#include "view/orbit_camera.hpp"
#include "view/tap.hpp"
#include "view/touch.hpp"

namespace rill::view {

class Controls {
 public:
  OrbitCamera camera{CameraView{}};

  /// Handles pointer, button and wheel events in the image's area and ignores others. `overPanels`: the pointer is over a
  /// panel. `paused`: fluid and solids cannot be moved.
  Expected<void> handle(const InputEvent& event, const Area& area, Session& session, bool overPanels, bool paused);
  /// Call after the scene was restarted.
  void reset();
  /// Throws the scene's `fluid` (empty: the first) at what is under the pointer.
  Expected<uint64_t> throwFluid(Session& session, const Area& area, const std::string& fluid) const {
    return Touch::throwFluid(session, ray(area), fluid);
  }
  /// Throws a crate likewise. What is grabbed is released.
  Expected<void> throwCrate(Session& session, const Area& area);
  /// Pours at what is under the pointer, and at what it moves to, until closeTap(). `flow`: m^3/s; 0: Tap::defaultFlow().
  Expected<void> openTap(Session& session, const Area& area, double flow, const std::string& fluid) {
    return tap_.open(session, ray(area), flow, fluid);
  }
  void closeTap(Session& session) { tap_.close(session); }
  /// In pixels of the window, where a body is pulled: from the point that it was grabbed by to where it is pulled to.
  std::optional<std::array<Place, 2>> pullLine(const Session& session, const Area& area) const;

 private:
  enum class Drag { None, Orbit, Pan, Dolly, Touch };
  Expected<void> press(const InputEvent& event, const Area& area, Session& session, bool paused);
  Ray ray(const Area& area) const;  // through the pointer

  Touch touch_;
  Tap tap_;
  Place pointer_, grabbed_;  // now; when the button was pressed
  Drag drag_ = Drag::None;
};

}  // namespace rill::view
