// Forces that change velocities after the solve: noise damping, vorticity confinement, drag.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "reference/solver.hpp"
#include "shared/fluid_records.h"
#include "sph/background_pressure.hpp"

namespace rill::reference {

double ReferenceSolver::xsphCoefficient(double viscosity, double dt) const {
  return 2 * viscosity * dt / (settings.density * kernel_.secondMoment());
}

void ReferenceSolver::dampNoise(double dt, double blockTime) {
  const double c = std::min(xsphCoefficient(restFactor_ * settings.viscosityAtRest, blockTime), double{kMaxNoiseDamping});
  const double layerSpeed = settings.sparedFlow / kSparedFlow;
  std::vector<glm::dvec3> noise = meanDifference(state.velocity);
  for (size_t i = 0; i < size() && c > 0 && settings.sparedFlow > 0; ++i) {
    const glm::dvec3 mean = state.velocity[i] + noise[i];
    const double layers = -state.warm[i] * inverseMass(i) / std::pow(dt * layerSpeed, 2);
    coherence_[i] = coherence(glm::length(mean), glm::length(noise[i]), layerSpeed, layers);
    noise[i] /= 1 + std::pow(glm::dot(mean, mean) / (settings.sparedFlow * settings.sparedFlow + glm::dot(noise[i], noise[i])), 2);
  }
  add(-c, meanDifference(noise));
}

std::vector<glm::dvec3> ReferenceSolver::meanDifference(const std::vector<glm::dvec3>& v) const {
  std::vector<glm::dvec3> difference(size(), glm::dvec3(0));
  for (size_t i = 0; i < size(); ++i)
    for (const Pair& pair : pairs(i))
      if (state.fluid[pair.j] == state.fluid[i]) difference[i] += pair.value * (pair.sign * v[pair.j] - v[i]);
  return difference;
}

void ReferenceSolver::add(double factor, const std::vector<glm::dvec3>& change) {
  for (size_t i = 0; i < size(); ++i) state.velocity[i] += factor * change[i];
}

void ReferenceSolver::vorticity(double dt) {
  const std::vector<glm::dvec3> v = state.velocity;
  const double h = kernel_.h();
  for (size_t i = 0; i < size(); ++i) {
    curl_[i] = glm::dvec3(0);
    for (const Pair& pair : neighbors(i)) curl_[i] += glm::cross(pair.gradient, v[pair.j] - v[i]);
  }
  for (size_t i = 0; i < size(); ++i) {
    const double strength = glm::length(curl_[i]);
    if (strength <= 0) continue;
    glm::dvec3 eta(0);
    for (const Pair& pair : neighbors(i)) eta += (glm::length(curl_[pair.j]) - strength) * pair.gradient;
    const glm::dvec3 toward = eta / (glm::length(eta) + 0.001 * strength / h);
    state.velocity[i] += dt * settings.vorticity * h * strength * glm::cross(toward, curl_[i]);
  }
}

void ReferenceSolver::drag(double dt) {
  for (glm::dvec3& v : state.velocity) v *= std::exp(-settings.drag * dt);
}

}  // namespace rill::reference
