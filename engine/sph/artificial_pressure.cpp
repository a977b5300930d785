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

ArtificialPressure::ArtificialPressure(const SmoothingKernel& kernel, double strength, double radius, double n) : power(n) {
  const double d = kernel.spacing(), scale = kernel.restGradientSum() / maxGradient(kernel);
  inverse = 1 / kernel.value(radius * kernel.h());
  least = std::min(kernel.value(0.95 * d) * inverse, 1.0);
  rate = least < 1 ? 28.7 * 9.81 * strength * scale : 0;
  most = 0.05 * d * scale;
}

double ArtificialPressure::factor(double value) const {
  return std::pow(std::clamp(value * inverse, least, 1.0), power) - std::pow(least, power);
}

}  // namespace rill
