#pragma once
// Values of command lines and scripts, read from text.
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "rill/expected.hpp"

namespace rill::apps {

/// The whole text as a number. Nothing: it is none, there is more, or it is beyond what the type holds.
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
/// "WIDTHxHEIGHT", each side from `least` to `most`. Nothing for another text.
std::optional<PixelSize> pixelSizeIn(std::string_view text, uint32_t least, uint32_t most);

/// `option` was given as `given`, where something else was expected.
Error badInput(std::string_view option, std::string_view given, std::string_view expected);

/// Names of the views for a help text.
std::string viewNames();
/// BadInput with the list of views where `name` is none.
Expected<void> checkView(const std::string& name);

}  // namespace rill::apps
