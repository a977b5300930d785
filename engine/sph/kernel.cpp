#include "sph/kernel.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace rill {

SmoothingKernel::SmoothingKernel(KernelChoice choice, double h, double d) : choice_(choice), h_(h), d_(d) {
  assert(h > 0 && d > 0);
  const int reach = static_cast<int>(std::ceil(h / d));
  const auto overLattice = [&](auto&& term) {
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int k = -reach; k <= reach; ++k) sum += term(d * i, d * std::sqrt(double(i * i + j * j + k * k)));
    return sum;
  };
  valueScale_ = 1 / overLattice([&](double, double r) { return value(r); });
  gradientScale_ = choice == KernelChoice::Wendland ? -20 * valueScale_ / (h * h) : -45 * d * d * d / (std::numbers::pi * h * h * h * h);
  restGradientSum_ = overLattice([&](double, double r) {
    const double slope = gradientOverR(r) * r;
    return slope * slope;
  });
  secondMoment_ = overLattice([&](double x, double r) { return value(r) * x * x; });
  gradientOfUnit_ = overLattice([&](double x, double r) { return -gradientOverR(r) * x * x; });
}

double SmoothingKernel::value(double r) const {
  if (r >= h_) return 0;
  const double q = r / h_;
  if (choice_ == KernelChoice::Wendland) {
    const double t = (1 - q) * (1 - q);
    return valueScale_ * t * t * (1 + 4 * q);
  }
  const double t = 1 - q * q;
  return valueScale_ * t * t * t;
}

double SmoothingKernel::gradientOverR(double r) const {
  if (r >= h_) return 0;
  const double t = 1 - r / h_;
  if (choice_ == KernelChoice::Wendland) return gradientScale_ * t * t * t;
  return r > 0 ? gradientScale_ * t * t / r : 0;
}

}  // namespace rill
