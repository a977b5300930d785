#include "sph/artificial_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace rill {
namespace {

/// Largest |grad K|, 1/m.
double maxGradient(const SmoothingKernel& kernel) {
  constexpr int kSamples = 1000;
  double slope = 0;
  for (int k = 1; k <= kSamples; ++k) {
    const double r = kernel.h() * k / kSamples;
    slope = std::max(slope, -kernel.gradientOverR(r) * r);
  }
  return slope;
}

}  // namespace

ArtificialPressure::ArtificialPressure(const SmoothingKernel& kernel, double strength, double radius, double n) : power(n), atRest(0) {
  const double d = kernel.spacing(), scale = kernel.restGradientSum() / maxGradient(kernel);
  inverse = 1 / kernel.value(radius * kernel.h());
  atRest = factor(kernel.value(0.95 * d));
  rate = atRest < 1 ? 28.7 * 9.81 * strength * scale : 0;
  most = 0.05 * d * scale;
}

double ArtificialPressure::factor(double value) const { return std::max(std::pow(std::min(value * inverse, 1.0), power) - atRest, 0.0); }

}  // namespace rill
