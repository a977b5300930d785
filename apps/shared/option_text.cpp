#include "shared/option_text.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/words.hpp"
#include "rill/offline.hpp"
#include "shared/words.hpp"

namespace rill::apps {
namespace {

std::vector<std::string> views() {
  const auto all = offline::Simulation::views();
  return {all.begin(), all.end()};
}

}  // namespace

std::optional<PixelSize> pixelSizeIn(std::string_view text, uint32_t least, uint32_t most) {
  const size_t x = text.find_first_of("xX");
  if (x == std::string_view::npos) return std::nullopt;
  const auto width = numberIn<uint32_t>(text.substr(0, x)), height = numberIn<uint32_t>(text.substr(x + 1));
  if (!width || !height || std::min(*width, *height) < least || std::max(*width, *height) > most) return std::nullopt;
  return PixelSize{*width, *height};
}

Error badInput(std::string_view option, std::string_view given, std::string_view expected) {
  return {ErrorKind::BadInput, std::string(option) + ": " + inQuotes(given) + " was given; expected " + std::string(expected)};
}

std::string viewNames() { return joined(views()); }

Expected<void> checkView(const std::string& name) {
  const std::vector<std::string> all = views();
  if (std::find(all.begin(), all.end(), name) != all.end()) return {};
  return Error{ErrorKind::BadInput, "--view: unknown view " + inQuotes(name) + didYouMean(name, all) + "\nviews: " + joined(all)};
}

Expected<double> exposureIn(const std::string& text) {
  const auto stops = numberIn<double>(text);
  if (stops && std::abs(*stops) <= offline::kMaxExposure_stops) return *stops;
  return badInput("--exposure", text, "a number of stops from -10 to 10");
}

}  // namespace rill::apps
