#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"

namespace rill::capture {

/// A figure of a whole run that the summary prints and --require can judge.
struct Figure {
  std::string name;
  double value = 0;       ///< NaN where the run has no such figure
  std::string_view unit;  ///< empty where it is a count or a fraction
};

/// "density_error_mean<0.001": a condition on a figure.
struct Requirement {
  enum class Comparison { Less, LessOrEqual, Greater, GreaterOrEqual };
  std::string text;  ///< as given
  std::string figure;
  Comparison comparison = Comparison::Less;
  double limit = 0;

  bool holds(double value) const;  ///< never for NaN
};

/// BadInput, saying what was expected, for what is no FIGURE<NUMBER.
Expected<Requirement> parseRequirement(std::string_view text);

/// BadInput with the list of figures and the nearest one for the first requirement on an unknown figure.
Expected<void> checkFigures(std::span<const Requirement> requirements, std::span<const std::string> known);

/// One message for each requirement that does not hold.
std::vector<std::string> failures(std::span<const Requirement> requirements, std::span<const Figure> figures);

}  // namespace rill::capture
