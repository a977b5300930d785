#include "sph/liquid_scale.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>

namespace rill {
namespace {

constexpr double kMinRatio = 2;  // below, sums of the lattices are up to 7 % apart, and rest states were not measured

/// Sum of K over the particles of a lattice around one of them; `atoms` a cubic cell, one of them at 0, in cells.
double sumOver(const SmoothingKernel& kernel, std::initializer_list<glm::dvec3> atoms) {
  const double cell = kernel.spacing() * std::cbrt(static_cast<double>(atoms.size()));
  const int reach = static_cast<int>(std::ceil(kernel.h() / cell));
  double sum = 0;
  for (int i = -reach - 1; i <= reach; ++i)
    for (int j = -reach - 1; j <= reach; ++j)
      for (int k = -reach - 1; k <= reach; ++k)
        for (const glm::dvec3& atom : atoms) sum += kernel.value(cell * glm::length(glm::dvec3(i, j, k) + atom));
  return sum;
}

}  // namespace

double liquidScale(const SmoothingKernel& kernel) {
  if (kernel.choice() != KernelChoice::Wendland || kernel.h() < kMinRatio * kernel.spacing()) return 1;
  const double bodyCentered = sumOver(kernel, {{0, 0, 0}, {0.5, 0.5, 0.5}});
  const double faceCentered = sumOver(kernel, {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}});
  return 1 / std::min({1.0, bodyCentered, faceCentered});
}

}  // namespace rill
