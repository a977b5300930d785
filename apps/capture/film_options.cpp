#include "capture/film_options.hpp"

#include "core/words.hpp"
#include "shared/option_text.hpp"

namespace rill::capture {
namespace {

/// The first of the options that was given.
const char* firstOf(const FilmText& text) {
  if (text.samples) return "--samples";
  if (text.shutter) return "--shutter";
  return text.aperture ? "--aperture" : text.focus ? "--focus" : nullptr;
}

Expected<double> number(const char* option, const std::string& text, double low, double high, const std::string& expected) {
  const auto value = apps::numberIn<double>(text);
  if (!value || !(*value >= low && *value <= high)) return apps::badInput(option, text, expected);
  return *value;
}

}  // namespace

offline::Film FilmOptions::film(double fps) const {
  return {.samples = samples, .shutter_s = shutter_deg / 360 / fps, .aperture = aperture, .focus_m = focus_m};
}

Expected<FilmOptions> filmOptions(const FilmText& text, std::string_view view, bool draws) {
  FilmOptions options;
  const char* first = firstOf(text);
  if (!first) return options;
  if (text.samples) {
    const auto samples = apps::numberIn<uint32_t>(*text.samples);
    if (!samples || *samples < 1 || *samples > offline::kMaxFilmSamples)
      return apps::badInput("--samples", *text.samples, "a whole number from 1 to " + std::to_string(offline::kMaxFilmSamples));
    options.samples = *samples;
  }
  if (text.shutter) {
    auto shutter = number("--shutter", *text.shutter, 0, 360, "a number of degrees from 0 to 360");
    if (!shutter) return shutter.error();
    options.shutter_deg = *shutter;
  }
  if (text.aperture) {
    auto aperture = number("--aperture", *text.aperture, offline::kMinAperture, offline::kMaxAperture, "an f-number from 0.5 to 64");
    if (!aperture) return aperture.error();
    options.aperture = *aperture;
  }
  if (text.focus) {
    auto focus = number("--focus", *text.focus, offline::kMinFocus_m, offline::kMaxFocus_m, "a distance from 0.001 to 1000000 m");
    if (!focus) return focus.error();
    if (!text.aperture) return Error{ErrorKind::BadInput, "--focus: found no --aperture, without which all is sharp; expected both"};
    options.focus_m = *focus;
  }
  if (options.samples == 1 && (options.shutter_deg > 0 || options.aperture > 0))
    return Error{ErrorKind::BadInput, "--samples: found 1 with " + std::string(options.shutter_deg > 0 ? "--shutter" : "--aperture") +
                                          ", which is a mean of several; expected at least 2"};
  if (view != "final")
    return Error{ErrorKind::BadInput,
                 std::string(first) + ": the view " + std::string(view) + " has no film effects; expected --view final"};
  if (!draws) return Error{ErrorKind::BadInput, std::string(first) + ": found --no-images without --video; expected images to draw"};
  return options;
}

}  // namespace rill::capture
