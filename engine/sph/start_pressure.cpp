#include "sph/start_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill {

StartPressure startPressure(const SmoothingKernel& kernel, double relaxation, double regularization, double layers, uint32_t most) {
  constexpr double kOfTheory = 0.9;  // a column of 100 layers converged soonest with 0.83 to 0.89; 1.0 and above leave its longest wave
  constexpr double kFades = 5;       // e-foldings of that wave
  const double k = std::numbers::pi / (2 * layers * kernel.spacing());
  const double share = relaxation * k * k / (kernel.restGradientSum() * (1 + regularization));
  const double rate = std::min(kOfTheory * std::sqrt(share), 1.0);
  return {static_cast<uint32_t>(std::min(std::ceil(kFades / rate), static_cast<double>(most))), (1 - rate) * (1 - rate)};
}

}  // namespace rill
