#pragma once
#include <string>

namespace rill::view {

/// An input event from the window or a script. Keys, buttons and modifiers have GLFW's numbers.
struct InputEvent {
  enum class Kind {
    Move,    ///< the pointer moved to x, y (pixels of the framebuffer, from the top left)
    Button,  ///< `code` was pressed or released
    Wheel,   ///< scrolled by x, y notches
    Key,     ///< `code` was pressed or released
    Text,    ///< typed text, UTF-8
    Drop,    ///< a file of this path was dropped onto the window
    Focus    ///< gained (down) or lost
  };
  Kind kind = Kind::Move;
  double x = 0, y = 0;
  int code = 0;
  bool down = false;
  int modifiers = 0;
  std::string text;
};

}  // namespace rill::view
