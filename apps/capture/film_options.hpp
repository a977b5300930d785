#pragma once
// Options of film effects: --samples, --shutter, --aperture, --focus.
#include <optional>
#include <string>
#include <string_view>

#include "rill/offline.hpp"

namespace rill::capture {

/// As text; empty where not given.
struct FilmText {
  std::optional<std::string> samples, shutter, aperture, focus;
};

struct FilmOptions {
  uint32_t samples = 0;    ///< 0: by the effects
  double shutter_deg = 0;  ///< 0 to 360, of a frame's time
  double aperture = 0;     ///< f-number; 0: none
  double focus_m = 0;      ///< 0: to the camera's target

  offline::Film film(double fps) const;
};

/// BadInput with the option, what was given and what was expected. `draws`: there are images or a video.
Expected<FilmOptions> filmOptions(const FilmText& text, std::string_view view, bool draws);

}  // namespace rill::capture
