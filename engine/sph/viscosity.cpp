#include "sph/viscosity.hpp"

#include <algorithm>
#include <cmath>

namespace rill {
namespace {

/// The sum of viscousWeight q^power over the rest lattice.
double viscousMoment(const SmoothingKernel& kernel, int power) {
  const double spacing = kernel.spacing() / kernel.h();
  const int reach = static_cast<int>(std::ceil(1 / spacing));
  double sum = 0;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const double q = spacing * std::sqrt(double(i * i + j * j + k * k));
        sum += viscousWeight(q) * std::pow(q, power);
      }
  return sum;
}

}  // namespace

double viscousWeight(double q) {
  const double t = std::max(1 - q, 0.0);
  return t * t * t;
}

double viscosityRate(double viscosity, double density, const SmoothingKernel& kernel) {
  return viscosity / (density * kernel.h() * kernel.h() * viscousMoment(kernel, 4) / 30);
}

double latticeBound(double coefficient, const SmoothingKernel& kernel) { return 1 + 2 * coefficient * viscousMoment(kernel, 2) / 3; }

}  // namespace rill
