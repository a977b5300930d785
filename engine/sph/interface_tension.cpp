#include "sph/interface_tension.hpp"

#include <algorithm>
#include <cmath>

namespace rill {

InterfaceCover wholeCover() {
  InterfaceCover cover;
  for (auto& row : cover) row.fill(1);
  return cover;
}

// The energy of an interface of drops that have come to rest is (1 - m / 0.82)^2.18 of that with m = 0. Beyond 0.82 samples are covered.
double interfaceCover(double share) {
  constexpr double kWhole = 0.82, kPower = 2.18;
  return kWhole * (1 - std::pow(std::clamp(share, 0.0, 1.0), 1 / kPower));
}

}  // namespace rill
