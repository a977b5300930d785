#pragma once
#include <cstdint>
#include <string>

namespace rill::view {

/// Settings of the window, which keys, panels and scripts change.
struct Settings {
  std::string view = "final";
  bool paused = false, panels = true, help = false;
  uint32_t body = 0;  ///< index of the solid whose figures the panel of bodies shows
  double scale = 0;   ///< resolution of the image; 0: automatic
};

}  // namespace rill::view
