#include "reference/pressure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "shared/pressure_probe.h"

namespace rill::reference {

double pressureAt(const glm::dvec3& x, std::span<const glm::dvec3> places, std::span<const double> multipliers,
                  const SmoothingKernel& kernel, double density, double dt) {
  const double support = kernel.h();
  const auto forEach = [&](auto&& visit) {
    for (size_t i = 0; i < places.size(); ++i) {
      const glm::dvec3 r = places[i] - x;
      const double distance = glm::length(r);
      if (distance < support)
        visit(kernel.value(distance), r / support, -multipliers[i] * density * kernel.gradientOfUnit() / (dt * dt), distance);
    }
  };
  double weights = 0, mean = 0, nearest = std::numeric_limits<double>::infinity();
  glm::dvec3 center(0), slope(0);
  forEach([&](double weight, const glm::dvec3& r, double pressure, double distance) {
    weights += weight;
    center += weight * r;
    mean += weight * pressure;
    nearest = std::min(nearest, distance);
  });
  if (!(nearest <= double{kWetDistance} * kernel.spacing())) return 0;
  center /= weights;
  mean /= weights;
  glm::dmat3 covariance(double{kPressureRidge});
  forEach([&](double weight, const glm::dvec3& r, double pressure, double) {
    covariance += weight / weights * glm::outerProduct(r - center, r - center);
    slope += weight / weights * (pressure - mean) * (r - center);
  });
  return std::max(mean - glm::dot(glm::inverse(covariance) * slope, center), 0.0);
}

}  // namespace rill::reference
