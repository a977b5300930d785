#pragma once
// The mouse over the picture: a camera that it moves, and a hand in the scene.
#include <functional>

#include "view/input.hpp"
#include "view/layout.hpp"
#include "view/orbit_camera.hpp"
#include "view/touch.hpp"

namespace rill::view {

class Controls {
 public:
  OrbitCamera camera{CameraView{}};

  /// Moves, buttons and the wheel, over the picture's area; other events are not for it. `panels`: the mouse is over them.
  /// `still`: nothing moves, so that there is nothing to push.
  Expected<void> take(const InputEvent& event, const Area& area, Session& session, bool panels, bool still);
  /// After the scene began anew.
  void forget();
  /// Fluid thrown at what is under the pointer.
  Expected<uint64_t> throwFluid(Session& session, const Area& area) const { return Touch::throwFluid(session, ray(area)); }

 private:
  enum class Drag { None, Orbit, Pan, Dolly, Touch };
  struct Place {
    double x = 0, y = 0;  // pixels
  };
  Expected<void> press(const InputEvent& event, const Area& area, Session& session, bool still);
  Ray ray(const Area& area) const;  // through the pointer

  Touch touch_;
  Place pointer_, grip_;  // the pointer; where it was when it took hold
  Drag drag_ = Drag::None;
};

}  // namespace rill::view
