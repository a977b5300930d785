#include "view/controls.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace rill::view {
namespace {

/// Offset from the image's center, right and down, in image heights.
std::array<double, 2> fromCenter(double x, double y, const Area& area) {
  return {(x - area.x - 0.5 * area.width) / area.height, (y - area.y - 0.5 * area.height) / area.height};
}

}  // namespace

Ray Controls::ray(const Area& area) const {
  const auto [right, down] = fromCenter(pointer_.x, pointer_.y, area);
  return rayThrough(camera.view(), right, down);
}

Expected<void> Controls::throwCrate(Session& session, const Area& area) {
  if (drag_ == Drag::Touch) drag_ = Drag::None;
  if (auto released = touch_.release(session); !released) return released;
  return Touch::throwCrate(session, ray(area));
}

std::optional<std::array<Place, 2>> Controls::pullLine(const Session& session, const Area& area) const {
  const auto line = touch_.pullLine(session);
  if (!line) return std::nullopt;
  std::array<Place, 2> places;
  for (size_t k = 0; k < 2; ++k) {
    const auto at = imagePlace(camera.view(), (*line)[k]);
    if (!at) return std::nullopt;
    places[k] = {area.x + 0.5 * area.width + (*at)[0] * area.height, area.y + 0.5 * area.height + (*at)[1] * area.height};
  }
  return places;
}

void Controls::reset() {
  touch_.reset();
  tap_.reset();
  if (drag_ == Drag::Touch) drag_ = Drag::None;
}

Expected<void> Controls::press(const InputEvent& event, const Area& area, Session& session, bool paused) {
  grabbed_ = pointer_;
  const bool right = event.code == GLFW_MOUSE_BUTTON_RIGHT, left = event.code == GLFW_MOUSE_BUTTON_LEFT;
  if ((left || right) && !paused && !(event.modifiers & (GLFW_MOD_ALT | GLFW_MOD_SHIFT))) {
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

Expected<void> Controls::handle(const InputEvent& event, const Area& area, Session& session, bool overPanels, bool paused) {
  switch (event.kind) {
    case InputEvent::Kind::Move: {
      const double right = (event.x - pointer_.x) / area.height, down = (event.y - pointer_.y) / area.height;
      pointer_ = {event.x, event.y};
      const auto grabbed = fromCenter(grabbed_.x, grabbed_.y, area);
      if (drag_ == Drag::Orbit) camera.orbit(right, down);
      if (drag_ == Drag::Pan) camera.pan(right, down);
      if (drag_ == Drag::Dolly) camera.dolly(-20 * down, grabbed[0], grabbed[1]);
      if (drag_ == Drag::Touch) touch_.drag(session, camera.view(), ray(area));
      tap_.move(session, camera.view(), ray(area));
      return {};
    }
    case InputEvent::Kind::Button: {
      const bool held = drag_ == Drag::Touch;
      drag_ = Drag::None;
      if (held)
        if (auto released = touch_.release(session); !released) return released;
      return event.down && !overPanels ? press(event, area, session, paused) : Expected<void>();
    }
    case InputEvent::Kind::Wheel:
      if (!overPanels) {
        const auto [right, down] = fromCenter(pointer_.x, pointer_.y, area);
        camera.dolly(event.y, right, down);
      }
      return {};
    default:
      return {};
  }
}

}  // namespace rill::view
