#pragma once
// Default values of the keys as JSON, for the schema and the key table.
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "model/fields.hpp"

namespace rill {

using OrderedJson = nlohmann::ordered_json;

/// An integer if the number is whole, so that it prints as 3 and not 3.0.
inline OrderedJson tidyNumber(double number) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (number == std::floor(number) && std::abs(number) <= kExact) return static_cast<int64_t>(number);
  return number;
}

template <class Vector>
OrderedJson numbersJson(const Vector& vector) {
  OrderedJson numbers = OrderedJson::array();
  for (const double number : vector) numbers.push_back(tidyNumber(number));
  return numbers;
}

/// The default of a key; null if it has none. `value` is the member's initializer.
inline OrderedJson defaultJson(const model::Info& info, double value) {
  return info.range.contains(value) ? tidyNumber(value) : OrderedJson();
}
inline OrderedJson defaultJson(const model::Info&, bool value) { return value; }
inline OrderedJson defaultJson(const model::Info& info, uint32_t value) { return defaultJson(info, static_cast<double>(value)); }
inline OrderedJson defaultJson(const model::Info& info, uint64_t value) { return defaultJson(info, static_cast<double>(value)); }
inline OrderedJson defaultJson(const model::Info& info, const std::string& value) {
  return info.required || value.empty() ? OrderedJson() : OrderedJson(value);
}
inline OrderedJson defaultJson(const model::Info& info, const std::optional<double>& value) {
  return value ? tidyNumber(*value) : info.unset.empty() ? OrderedJson() : OrderedJson(info.unset);
}
inline OrderedJson defaultJson(const model::Info&, const std::pair<double, double>& value) {
  return OrderedJson::array({tidyNumber(value.first), tidyNumber(value.second)});
}
inline OrderedJson defaultJson(const model::Info& info, SideMask value) {
  OrderedJson sides = OrderedJson::array();
  for (size_t side = 0; side < info.words.size(); ++side) {
    if ((value >> side & 1) != 0) sides.push_back(info.words[side]);
  }
  return sides;
}
inline OrderedJson defaultJson(const model::Info&, const Double3& value) { return numbersJson(value); }
inline OrderedJson defaultJson(const model::Info&, const Quaternion& value) { return numbersJson(value); }
template <class Enum>
requires std::is_enum_v<Enum> OrderedJson defaultJson(const model::Info& info, const Enum& value) {
  return OrderedJson(info.words[static_cast<size_t>(value)]);
}
template <class T>
OrderedJson defaultJson(const model::Info&, const std::vector<T>&) {
  return OrderedJson::array();
}
/// Files, structs and optional structs have no default of their own.
template <class T>
OrderedJson defaultJson(const model::Info&, const T&) {
  return {};
}

}  // namespace rill
