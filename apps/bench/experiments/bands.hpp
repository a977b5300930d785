#pragma once
#include <string_view>

#include "bench/experiments/experiment.hpp"

namespace rill::bench {

/// Aim and pass band of a figure. The magnitude of the signed error is compared.
struct Band {
  std::string_view family;  ///< prefix of the families that it applies to
  std::string_view figure;
  double aim = 0;           ///< error that a solver should reach; NaN: none
  double band[kLevels]{};   ///< largest passing error per level; infinite: shown, not checked
  std::string_view unit;    ///< "%", or the unit of the error
  std::string_view reason;  ///< why the band is wider than the aim
};
/// The first matching band, or null.
const Band* bandOf(std::string_view family, std::string_view figure);

}  // namespace rill::bench
