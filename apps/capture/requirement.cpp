#include "capture/requirement.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/words.hpp"
#include "shared/words.hpp"

namespace rill::capture {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

bool Requirement::holds(double value) const {
  switch (comparison) {
    case Comparison::Less:
      return value < limit;
    case Comparison::LessOrEqual:
      return value <= limit;
    case Comparison::Greater:
      return value > limit;
    case Comparison::GreaterOrEqual:
      return value >= limit;
  }
  return false;
}

Expected<Requirement> parseRequirement(std::string_view text) {
  const Error malformed{
      ErrorKind::BadInput,
      "--require: " + inQuotes(text) +
          " was given; expected FIGURE<NUMBER (or <=, >, >=), quoted for the shell, for example 'density_error_mean<0.001'"};
  const size_t sign = text.find_first_of("<>");
  if (sign == std::string_view::npos) return malformed;
  Requirement requirement;
  requirement.text = text;
  requirement.figure = trimmed(text.substr(0, sign));
  const bool less = text[sign] == '<', orEqual = sign + 1 < text.size() && text[sign + 1] == '=';
  using enum Requirement::Comparison;
  requirement.comparison = less ? (orEqual ? LessOrEqual : Less) : (orEqual ? GreaterOrEqual : Greater);
  const std::string_view number = trimmed(text.substr(sign + (orEqual ? 2 : 1)));
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), requirement.limit);
  const bool whole = error == std::errc{} && end == number.data() + number.size() && std::isfinite(requirement.limit);
  if (requirement.figure.empty() || !whole) return malformed;
  return requirement;
}

Expected<void> checkFigures(std::span<const Requirement> requirements, std::span<const std::string> known) {
  for (const Requirement& requirement : requirements) {
    if (std::find(known.begin(), known.end(), requirement.figure) != known.end()) continue;
    return Error{ErrorKind::BadInput, "--require: unknown figure " + inQuotes(requirement.figure) +
                                          apps::didYouMean(requirement.figure, known) + "\nfigures: " + apps::joined(known)};
  }
  return {};
}

std::vector<std::string> failures(std::span<const Requirement> requirements, std::span<const Figure> figures) {
  std::vector<std::string> messages;
  for (const Requirement& requirement : requirements) {
    const auto figure = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.name == requirement.figure; });
    const double value = figure == figures.end() ? NAN : figure->value;
    if (requirement.holds(value)) continue;
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", value);
    messages.push_back("--require: " + inQuotes(requirement.text) + " does not hold: " + requirement.figure + " is " +
                       (std::isnan(value) ? "undefined here" : text));
  }
  return messages;
}

}  // namespace rill::capture
