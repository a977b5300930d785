#include "view/input_handler.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <string>
#include <vector>

#include "rill/offline.hpp"
#include "view/cycled.hpp"

namespace rill::view {

namespace {

bool isKeyOf(Action action, int key) {
  return std::ranges::any_of(keyBindings(), [&](const KeyBinding& binding) { return binding.action == action && binding.key == key; });
}

}  // namespace

Expected<void> InputHandler::handle(const InputEvent& event) {
  switch (event.kind) {
    case InputEvent::Kind::Move:
    case InputEvent::Kind::Button:
    case InputEvent::Kind::Wheel:
      return shown_.handle(event, interface_.wantsMouse());
    case InputEvent::Kind::Key:
      if (!event.down && isKeyOf(Action::Pour, event.code)) shown_.closeTap();
      if (!event.down || interface_.wantsKeys() || (event.modifiers & GLFW_MOD_CONTROL)) return {};
      if (event.code == GLFW_KEY_ESCAPE) settings_.help = false;
      for (const KeyBinding& binding : keyBindings())
        if (binding.key == event.code) return perform(binding.action, event.modifiers & GLFW_MOD_SHIFT);
      return {};
    case InputEvent::Kind::Focus:
      if (!event.down) shown_.closeTap();  // the window does not see the key's release
      return {};
    case InputEvent::Kind::Drop:
      return scenes_.openDropped(event.text);
    default:
      return {};
  }
}

Expected<void> InputHandler::perform(Action action, bool shift) {
  switch (action) {
    case Action::Pause:
      settings_.paused = !settings_.paused;
      break;
    case Action::OneStep:
      shown_.pauseAfterOneStep();
      break;
    case Action::Restart:
      return shown_.restart();
    case Action::PreviousScene:
      return scenes_.openNext(-1);
    case Action::NextScene:
      return scenes_.openNext(1);
    case Action::NextView: {
      const auto views = offline::Simulation::views();
      settings_.view = cycled(std::vector<std::string>(views.begin(), views.end()), settings_.view, shift ? -1 : 1);
      break;
    }
    case Action::Throw:
      return shown_.throwFluid();
    case Action::ThrowCrate:
      return shown_.throwCrate();
    case Action::Pour:
      return shown_.openTap();
    case Action::Home:
      shown_.camera().home();
      break;
    case Action::Front:
      shown_.camera().look(AxisView::Front);
      break;
    case Action::Back:
      shown_.camera().look(AxisView::Back);
      break;
    case Action::Right:
      shown_.camera().look(AxisView::Right);
      break;
    case Action::Left:
      shown_.camera().look(AxisView::Left);
      break;
    case Action::Top:
      shown_.camera().look(AxisView::Top);
      break;
    case Action::Bottom:
      shown_.camera().look(AxisView::Bottom);
      break;
    case Action::TiltLeft:
      return shown_.tilt(Tilt::Left);
    case Action::TiltRight:
      return shown_.tilt(Tilt::Right);
    case Action::TiltAway:
      return shown_.tilt(Tilt::Away);
    case Action::TiltTowards:
      return shown_.tilt(Tilt::Towards);
    case Action::Panels:
      settings_.panels = !settings_.panels;
      break;
    case Action::Theme:
      interface_.setTheme(interface_.theme() == Theme::Dark ? Theme::Light : Theme::Dark);
      break;
    case Action::Screenshot: {
      std::filesystem::path file;
      for (int k = 1; file.empty() || std::filesystem::exists(file); ++k) file = "rill-view-" + std::to_string(k) + ".png";
      screenshot_ = file;
      break;
    }
    case Action::Help:
      settings_.help = !settings_.help;
      break;
  }
  return {};
}

}  // namespace rill::view
