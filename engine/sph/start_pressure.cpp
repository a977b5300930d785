#include "sph/start_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill {

StartPressure startPressure(const SmoothingKernel& kernel, double relaxation, double regularization, double layers,
                            uint32_t maxIterations) {
  constexpr double kRateFactor = 0.9;  // measured; see docs/notes/initial-pressure.md
  constexpr double kEFoldings = 5;     // of the slowest wave
  const double k = std::numbers::pi / (2 * layers * kernel.spacing());
  const double reduction = relaxation * k * k / (kernel.restGradientSum() * (1 + regularization));
  const double rate = std::min(kRateFactor * std::sqrt(reduction), 1.0);
  return {static_cast<uint32_t>(std::min(std::ceil(kEFoldings / rate), static_cast<double>(maxIterations))), (1 - rate) * (1 - rate)};
}

}  // namespace rill
