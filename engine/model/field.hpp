#pragma once
// Types that describe one scene key. The descriptions are in fields.hpp.
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace rill::model {

/// The interval of numbers that a key accepts. Each number must also be representable as a 32-bit float.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< `low` itself is not accepted
  bool high_open = false;  ///< `high` itself is not accepted

  constexpr bool hasLow() const { return low != -std::numeric_limits<double>::infinity(); }
  constexpr bool hasHigh() const { return high != std::numeric_limits<double>::infinity(); }
  constexpr bool contains(double v) const { return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high); }
};
constexpr Range atLeast(double low) { return {.low = low}; }
constexpr Range above(double low) { return {.low = low, .low_open = true}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
constexpr Range aboveTo(double low, double high) { return {.low = low, .high = high, .low_open = true}; }
constexpr Range inside(double low, double high) { return {.low = low, .high = high, .low_open = true, .high_open = true}; }

/// Metadata of a key. Its default is the initializer of the C++ member in rill/scene.hpp.
struct Info {
  std::string_view key;
  std::string_view unit = {};  ///< empty: dimensionless, or not a number
  Range range = {};            ///< of a number, or of each number in an array
  std::string_view help;
  std::span<const std::string_view> words = {};  ///< accepted values of an enum or bit mask, in its order
  bool required = false;                         ///< the key must be given
  size_t most = 0;                               ///< largest number of entries of a list; 0: unlimited
  std::string_view since = {};                   ///< version that a scene must ask for to use the key; empty: any
  std::string_view parts = "[x, y, z]";          ///< of a vector of three, as messages show them
  std::string_view unset = "auto";               ///< value that leaves an optional number empty; "": leaving out the key alone does
  bool namesFluid = false;                       ///< a text that names one of fluids, so that "" is refused where the key is given
};

/// A key and the member of Owner that it sets. The type of the member selects how the value is read.
template <class Owner, class T>
struct Field {
  using Value = T;
  Info info;
  T Owner::*member;

  const T* find(const Owner& owner) const { return &(owner.*member); }
  T* find(Owner& owner) const { return &(owner.*member); }
  T& set(Owner& owner) const { return owner.*member; }  ///< the value to write to
};
template <class Owner, class T>
Field(Info, T Owner::*) -> Field<Owner, T>;

/// A key and the alternative T of a variant that it selects. Used like a Field; find() returns null for another alternative.
template <class Owner, class T, class Variant>
struct Alternative {
  using Value = T;
  Info info;
  Variant Owner::*member;

  const T* find(const Owner& owner) const { return std::get_if<T>(&(owner.*member)); }
  T* find(Owner& owner) const { return std::get_if<T>(&(owner.*member)); }
  T& set(Owner& owner) const { return (owner.*member).template emplace<T>(); }
};
template <class T, class Owner, class Variant>
constexpr Alternative<Owner, T, Variant> alternative(const Info& info, Variant Owner::*member) {
  return {info, member};
}

/// Type of a key that is accepted and ignored. Its Field has no member.
struct Ignored {};
/// Type of the version key, which is checked before all others. Its Field has no member.
struct Version {};

/// Table::one_of of a struct that has no alternatives.
inline constexpr std::array<std::string_view, 0> kNoWords{};

/// The description of a struct; fields.hpp specializes it with
///   static constexpr std::string_view about;     description in one line
///   static constexpr std::tuple fields;          of Field and Alternative, in the order of the documentation
///   static constexpr std::array<std::string_view, N> one_of;   exactly one of these keys must be given; N may be 0
///   static constexpr std::array<std::string_view, N> one_of_too;   optional: a second such choice
template <class Owner>
struct Table;

template <class T>
concept Described = requires {
  Table<T>::fields;
};

template <class T>
inline constexpr bool kHasMember = !std::is_same_v<T, Ignored> && !std::is_same_v<T, Version>;

/// Calls visit(field) for each key of Owner, in the order of the table.
template <class Owner, class Visit>
constexpr void forEachField(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Table<Owner>::fields);
}

/// The keys of Owner, in the order of the table.
template <class Owner>
std::vector<std::string_view> keysOf() {
  std::vector<std::string_view> keys;
  forEachField<Owner>([&](const auto& field) { keys.push_back(field.info.key); });
  return keys;
}

/// The choices of Owner: lists of keys of which exactly one must be given.
template <class Owner>
constexpr auto choicesOf() {
  using Keys = std::span<const std::string_view>;
  if constexpr (Table<Owner>::one_of.empty()) {
    return std::array<Keys, 0>{};
  } else if constexpr (requires { Table<Owner>::one_of_too; }) {
    return std::array<Keys, 2>{Table<Owner>::one_of, Table<Owner>::one_of_too};
  } else {
    return std::array<Keys, 1>{Table<Owner>::one_of};
  }
}

/// The described struct S in S, std::optional<S> or std::vector<S>; void for other types.
template <class T>
struct Inner {
  using Type = std::conditional_t<Described<T>, T, void>;
};
template <class T>
struct Inner<std::optional<T>> {
  using Type = std::conditional_t<Described<T>, T, void>;
};
template <class T>
struct Inner<std::vector<T>> {
  using Type = std::conditional_t<Described<T>, T, void>;
};

template <class T>
inline constexpr bool kIsList = false;
template <class T>
inline constexpr bool kIsList<std::vector<T>> = true;

}  // namespace rill::model
