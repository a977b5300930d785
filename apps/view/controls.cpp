#include "view/controls.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace rill::view {
namespace {

/// From the picture's middle, right and down, in its heights.
std::array<double, 2> fromMiddle(double x, double y, const Area& area) {
  return {(x - area.x - 0.5 * area.width) / area.height, (y - area.y - 0.5 * area.height) / area.height};
}

}  // namespace

Ray Controls::ray(const Area& area) const {
  const auto [right, down] = fromMiddle(pointer_.x, pointer_.y, area);
  return rayThrough(camera.view(), right, down);
}

void Controls::forget() {
  touch_.forget();
  if (drag_ == Drag::Touch) drag_ = Drag::None;
}

Expected<void> Controls::press(const InputEvent& event, const Area& area, Session& session, bool still) {
  grip_ = pointer_;
  const bool right = event.code == GLFW_MOUSE_BUTTON_RIGHT, left = event.code == GLFW_MOUSE_BUTTON_LEFT;
  if ((left || right) && !still && !(event.modifiers & (GLFW_MOD_ALT | GLFW_MOD_SHIFT))) {
    const auto held = touch_.grab(session, camera.view(), ray(area), right ? Hold::Solid : Hold::Fluid);
    if (!held) return held.error();
    if (*held) {
      drag_ = Drag::Touch;
      return {};
    }
  }
  drag_ = right ? Drag::Dolly : event.code == GLFW_MOUSE_BUTTON_MIDDLE || (event.modifiers & GLFW_MOD_SHIFT) ? Drag::Pan : Drag::Orbit;
  return {};
}

Expected<void> Controls::take(const InputEvent& event, const Area& area, Session& session, bool panels, bool still) {
  switch (event.kind) {
    case InputEvent::Kind::Move: {
      const double right = (event.x - pointer_.x) / area.height, down = (event.y - pointer_.y) / area.height;
      pointer_ = {event.x, event.y};
      const auto grip = fromMiddle(grip_.x, grip_.y, area);
      if (drag_ == Drag::Orbit) camera.orbit(right, down);
      if (drag_ == Drag::Pan) camera.pan(right, down);
      if (drag_ == Drag::Dolly) camera.dolly(-20 * down, grip[0], grip[1]);
      if (drag_ == Drag::Touch) touch_.drag(session, camera.view(), ray(area));
      return {};
    }
    case InputEvent::Kind::Button: {
      const bool held = drag_ == Drag::Touch;
      drag_ = Drag::None;
      if (held)
        if (auto gone = touch_.release(session); !gone) return gone;
      return event.down && !panels ? press(event, area, session, still) : Expected<void>();
    }
    case InputEvent::Kind::Wheel:
      if (!panels) {
        const auto [right, down] = fromMiddle(pointer_.x, pointer_.y, area);
        camera.dolly(event.y, right, down);
      }
      return {};
    default:
      return {};
  }
}

}  // namespace rill::view
