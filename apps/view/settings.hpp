#pragma once
#include <cstdint>
#include <string>

namespace rill::view {

/// Settings of the window, which keys, panels and scripts change.
struct Settings {
  std::string view = "final";
  double exposure_stops = 0;  ///< of the view final
  bool paused = false, panels = true, help = false;
  uint32_t body = 0;        ///< index of the solid whose figures the panel of bodies shows
  std::string poured = {};  ///< name of the fluid that the tap pours and that is thrown; none of the scene's: the first
  double tapFlow = 0;       ///< of the tap under the pointer, m^3/s; 0: Tap::defaultFlow()
  double scale = 0;         ///< resolution of the image; 0: automatic
};

}  // namespace rill::view
