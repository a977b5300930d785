#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"

namespace rill::capture {

/// A figure of a whole run, printed in the summary and tested by --require.
struct Figure {
  std::string name;
  double value = 0;       ///< NaN where undefined for this run
  std::string_view unit;  ///< empty for counts and ratios
};

/// "density_error_mean<0.001": a condition on a figure.
struct Requirement {
  enum class Comparison { Less, LessOrEqual, Greater, GreaterOrEqual };
  std::string text;  ///< as given
  std::string figure;
  Comparison comparison = Comparison::Less;
  double limit = 0;

  bool holds(double value) const;  ///< false for NaN
};

/// BadInput, with what was expected, for text that is not FIGURE<NUMBER.
Expected<Requirement> parseRequirement(std::string_view text);

/// BadInput for the first requirement on an unknown figure, with the nearest name and the list of figures.
Expected<void> checkFigures(std::span<const Requirement> requirements, std::span<const std::string> known);

/// One message for each requirement that does not hold.
std::vector<std::string> failures(std::span<const Requirement> requirements, std::span<const Figure> figures);

}  // namespace rill::capture
