#pragma once
// Key bindings: one table for the window, the help overlay, --help and scripts.
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
  ThrowCrate,
  Pour,
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
  int key;                ///< GLFW key
  std::string_view name;  ///< label of the key, and its name in scripts
  Action action;
  std::string_view about;
};
std::span<const KeyBinding> keyBindings();

/// Uses of the mouse, for the help.
struct MouseUse {
  std::string_view how, about;
};
std::span<const MouseUse> mouseUses();

/// Mouse uses and key bindings, one per line.
std::string keyHelp();

/// The key of a name in a script, case-insensitive; includes keys of text fields (Enter, Escape, ...).
std::optional<int> keyNamed(std::string_view name);

}  // namespace rill::view
