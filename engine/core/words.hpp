#pragma once
// Words and numbers in messages that a person reads.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rill {

/// The word of `known` that `word` is most likely a typo of (case ignored; a missing, extra, wrong or swapped letter, or a
/// beginning of it). Empty where none is near.
std::string_view nearestWord(std::string_view word, std::span<const std::string_view> known);

/// `text` in double quotes, control characters escaped, cut to about 60 bytes between whole characters.
std::string inQuotes(std::string_view text);

/// "50,000,000"
std::string grouped(uint64_t number);

/// The shortest text that reads back as the same double: "0.1", "1000", "1e-09".
std::string shortNumber(double number);

/// Four digits of it, for figures that are measured or estimated: "0.002307".
std::string roughNumber(double number);

/// `words` quoted, with commas: "\"a\", \"b\"".
std::string listInQuotes(std::span<const std::string_view> words);

/// `key` inside `path` as messages write it: "fluid.viscosity". A key that is no plain word is quoted.
std::string childPath(std::string_view path, std::string_view key);
/// "fill[2]"
std::string entryPath(std::string_view path, size_t index);

}  // namespace rill
