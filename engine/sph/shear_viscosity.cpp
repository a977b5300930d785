#include "sph/shear_viscosity.hpp"

#include <algorithm>
#include <cmath>

#include "shared/shear_viscosity.h"
#include "shared/viscosity_steps.h"

namespace rill {

bool isShearDependent(const Rheology& rheology) {
  return rheology.yieldStress > 0 || (rheology.flowIndex != 1 && rheology.consistency > 0);
}

double viscosityAt(const Rheology& r, double rate) {
  const double bounded = std::clamp<double>(rate, kMinShearRate, kMaxShearRate);
  return r.yieldStress / bounded + r.consistency * std::pow(bounded, r.flowIndex - 1);
}

// A sum of powers, each convex where it falls and monotone else: the largest value is at an end.
double largestViscosity(const Rheology& rheology) { return std::max(viscosityAt(rheology, 0), viscosityAt(rheology, kMaxShearRate)); }

double reachedBound(unsigned steps) {
  double reached = 1, beyond = 1e9;
  for (int k = 0; k < 60; ++k) {
    const double middle = std::sqrt(reached * beyond);
    (shared::viscositySteps(middle, steps).remaining <= shared::kViscosityRemaining ? reached : beyond) = middle;
  }
  return reached;
}

}  // namespace rill
