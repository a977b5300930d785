#include "sph/pair_weight.hpp"

#include <algorithm>
#include <cmath>

namespace rill {

double pairWeight(double q) {
  const double t = std::max(1 - q, 0.0);
  return t * t * t;
}

double pairMoment(const SmoothingKernel& kernel, int power) {
  const double spacing = kernel.spacing() / kernel.h();
  const int reach = static_cast<int>(std::ceil(1 / spacing));
  double sum = 0;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k) {
        if (i == 0 && j == 0 && k == 0) continue;
        const double q = spacing * std::sqrt(double(i * i + j * j + k * k));
        sum += pairWeight(q) * std::pow(q, power);
      }
  return sum;
}

}  // namespace rill
