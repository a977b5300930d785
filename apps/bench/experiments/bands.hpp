#pragma once
#include <span>
#include <string_view>

#include "bench/experiments/experiment.hpp"

namespace rill::bench {

/// What is asked of a figure. Errors are signed; their size counts.
struct Band {
  std::string_view family;  ///< experiments whose family begins with this
  std::string_view figure;
  double aim = 0;           ///< what a solver should reach; NaN: there is none
  double band[kLevels]{};   ///< what this one must keep at each level; infinite: shown, not judged
  std::string_view unit;    ///< "%", or what the number is in
  std::string_view reason;  ///< of the band, where it is wider than the aim
};
std::span<const Band> bands();
/// Of one figure of an experiment; none where it is shown only.
const Band* bandOf(std::string_view family, std::string_view figure);

}  // namespace rill::bench
