#include "sph/viscosity.hpp"

namespace rill {

double viscosityRate(double viscosity, double density, const SmoothingKernel& kernel) {
  return viscosity / (density * kernel.h() * kernel.h() * pairMoment(kernel, 4) / 30);
}

double latticeBound(double coefficient, const SmoothingKernel& kernel) { return 1 + 2 * coefficient * pairMoment(kernel, 2) / 3; }

}  // namespace rill
