#pragma once
// Formatting of words and numbers in messages.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "rill/vectors.hpp"

namespace rill {

/// The word of `known` that `word` is most likely a typo or a prefix of, ignoring case. Empty if none is
/// close enough.
std::string_view nearestWord(std::string_view word, std::span<const std::string_view> known);

/// `text` in double quotes with control characters escaped, truncated to 60 bytes at a UTF-8 boundary.
std::string inQuotes(std::string_view text);

/// With thousands separators: "50,000,000".
std::string grouped(uint64_t number);

/// The shortest text that parses to the same double: "0.1", "1000", "1e-09".
std::string shortestNumber(double number);

/// Four significant digits, for measured or estimated values: "0.002307".
std::string roundedNumber(double number);
/// Such numbers as "[x, y, z]".
std::string roundedPlace(const Double3& place);

/// `words` in quotes, separated by commas: "\"a\", \"b\"".
std::string quotedList(std::span<const std::string_view> words);

/// The path of `key` in the object at `path`: "fluid.viscosity". A key with special characters is quoted.
std::string memberPath(std::string_view path, std::string_view key);
/// The path of element `index` of the array at `path`: "fill[2]".
std::string elementPath(std::string_view path, size_t index);

}  // namespace rill
