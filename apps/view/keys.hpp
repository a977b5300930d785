#pragma once
// What the keys do: one table for the window, the help, `--help` and scripts.
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rill::view {

enum class Action {
  Pause,
  OneStep,
  Restart,
  PreviousScene,
  NextScene,
  NextView,
  Throw,
  Home,
  Front,
  Back,
  Right,
  Left,
  Top,
  Bottom,
  TiltLeft,
  TiltRight,
  TiltAway,
  TiltTowards,
  Panels,
  Theme,
  Screenshot,
  Help
};

struct KeyBinding {
  int key;                ///< as GLFW numbers it
  std::string_view name;  ///< what stands on it; what scripts call it
  Action action;
  std::string_view about;
};
std::span<const KeyBinding> keyBindings();

/// What hands do with the mouse, for the help.
struct MouseUse {
  std::string_view how, about;
};
std::span<const MouseUse> mouseUses();

/// Both as lines of text.
std::string keyHelp();

/// The key of a name in a script, upper or lower case; also those that panels alone use (Enter, Escape ...).
std::optional<int> keyNamed(std::string_view name);

}  // namespace rill::view
