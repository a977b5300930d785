#pragma once
// Particle clouds and sums for the tests of the reference solver.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "reference/solver.hpp"
#include "support/random_cloud.hpp"

namespace rill::reference {

/// A lattice of nx x ny x nz points, the first half a spacing inside `from`.
inline std::vector<glm::dvec3> lattice(int nx, int ny, int nz, double d, glm::dvec3 from = glm::dvec3(0)) {
  std::vector<glm::dvec3> x;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) x.push_back(from + d * glm::dvec3(i + 0.5, j + 0.5, k + 0.5));
  return x;
}

using test::randomCloud;

inline glm::dvec3 meanVelocity(const ReferenceSolver& solver) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& v : solver.state.velocity) sum += v;
  return sum / double(solver.size());
}

inline glm::dvec3 centerOfMass(const ReferenceSolver& solver) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& x : solver.state.position) sum += x;
  return sum / double(solver.size());
}

inline double rmsSpeed(const ReferenceSolver& solver) {
  double sum = 0;
  for (const glm::dvec3& v : solver.state.velocity) sum += glm::dot(v, v);
  return std::sqrt(sum / double(solver.size()));
}

/// Kinetic and potential energy, J; potential energy is 0 at the origin.
inline double energy(const ReferenceSolver& solver) {
  double sum = 0;
  for (size_t i = 0; i < solver.size(); ++i)
    sum += glm::dot(solver.state.velocity[i], solver.state.velocity[i]) / 2 - glm::dot(solver.settings.gravity, solver.state.position[i]);
  return sum * solver.mass();
}

/// Mean compression, a fraction of rho0, of the last density evaluation.
inline double compression(const ReferenceSolver& solver) {
  double sum = 0;
  for (const double ratio : solver.densityRatio()) sum += std::max(0.0, ratio - 1);
  return sum / double(solver.size());
}

inline ReferenceSettings tank(double d, glm::dvec3 hi) {
  ReferenceSettings s;
  s.spacing = d;
  s.lo = glm::dvec3(0);
  s.hi = hi;
  s.tabulated = true;
  return s;
}

}  // namespace rill::reference
