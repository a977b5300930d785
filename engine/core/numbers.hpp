#pragma once
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace rill {

/// The number that the whole word is, whatever the locale; infinity if a double cannot hold it.
inline std::optional<double> parseNumber(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
  if (word.empty() || read.ec == std::errc::invalid_argument || read.ptr != word.data() + word.size()) return {};
  return read.ec == std::errc::result_out_of_range ? std::numeric_limits<double>::infinity() : number;
}

/// Whether it is finite and a 32-bit float can hold it.
inline bool fitsFloat(double number) { return std::abs(number) <= std::numeric_limits<float>::max(); }  // false for NaN

}  // namespace rill
