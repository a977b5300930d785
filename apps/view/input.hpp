#pragma once
#include <string>

namespace rill::view {

/// Something that a hand did, from the window or from a script. Keys, buttons and modifiers are numbered as GLFW does.
struct InputEvent {
  enum class Kind {
    Move,    ///< the pointer is at x, y (pixels of the framebuffer, from the top left)
    Button,  ///< `code` went down or up
    Wheel,   ///< by x, y notches
    Key,     ///< `code` went down or up
    Text,    ///< was typed, UTF-8
    Drop,    ///< a file of this path was dropped onto the window
    Focus    ///< came (down) or went
  };
  Kind kind = Kind::Move;
  double x = 0, y = 0;
  int code = 0;
  bool down = false;
  int modifiers = 0;
  std::string text;
};

}  // namespace rill::view
