#pragma once
// Parses values of command lines and scripts.
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "rill/expected.hpp"

namespace rill::apps {

/// The whole text as a number; nullopt for anything else, or where the type cannot hold it.
template <class Number>
std::optional<Number> numberIn(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

struct PixelSize {
  uint32_t width = 0, height = 0;
};
/// "WIDTHxHEIGHT", each side from `least` to `most`; nullopt for anything else.
std::optional<PixelSize> pixelSizeIn(std::string_view text, uint32_t least, uint32_t most);

/// "OPTION: "GIVEN" was given; expected EXPECTED".
Error badInput(std::string_view option, std::string_view given, std::string_view expected);

/// The names of the views, for help texts.
std::string viewNames();
/// BadInput with the list of views where `name` is not one.
Expected<void> checkView(const std::string& name);

/// The value of --exposure, stops.
Expected<double> exposureIn(const std::string& text);

}  // namespace rill::apps
