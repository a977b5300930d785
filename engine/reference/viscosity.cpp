// Viscosity as an implicit step, (1 + dt L) v' = v, with L v = -f(v) of sph/viscosity.hpp.
#include "sph/viscosity.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "reference/solver.hpp"
#include "shared/viscosity_steps.h"

namespace rill::reference {
namespace {

using Field = std::vector<glm::dvec3>;

/// a + factor b.
Field sum(const Field& a, double factor, const Field& b) {
  Field all = a;
  for (size_t i = 0; i < a.size(); ++i) all[i] += factor * b[i];
  return all;
}

}  // namespace

double ReferenceSolver::pairViscosity(size_t i, size_t j) const {
  if (settings.fluids.empty()) return 1;
  const double own = settings.fluids[state.fluid[i]].viscosity, other = settings.fluids[state.fluid[j]].viscosity;
  return own > 0 && other > 0 ? 2 / (1 / own + 1 / other) / settings.viscosity : 0;
}

Field ReferenceSolver::viscousForce(double c, const Field& v) const {
  Field force(size(), glm::dvec3(0));
  for (size_t i = 0; i < size(); ++i)
    for (const Pair& pair : pairs(i)) {
      const glm::dvec3 image = settings.noSlipWalls ? pair.sign.x * pair.sign.y * pair.sign.z * pair.sign : pair.sign;
      const glm::dvec3 q = pair.offset / kernel_.h();
      const double factor = c * inverseMass(i) * pairViscosity(i, pair.j);
      force[i] += factor * pairWeight(glm::length(q)) * glm::dot(q, image * v[pair.j] - v[i]) * q;
    }
  return force;
}

double ReferenceSolver::viscosityBound(double c, std::span<const double> held) const {
  double bound = 1;
  for (size_t i = 0; i < size(); ++i) {
    glm::dmat3 own(0);
    for (const Pair& pair : pairs(i)) {
      const glm::dvec3 q = pair.offset / kernel_.h();
      own += inverseMass(i) * pairViscosity(i, pair.j) * pairWeight(glm::length(q)) * glm::outerProduct(q, q);
    }
    for (int a = 0; a < 3; ++a)
      bound = std::max(bound, 1 + 2 * c * (std::abs(own[a].x) + std::abs(own[a].y) + std::abs(own[a].z)) + held[i]);
  }
  return bound;
}

// By Chebyshev's iteration with the steps of the shaders, or by conjugate gradients to rounding.
void ReferenceSolver::viscosity(double dt) {
  const double c = viscosityRate(settings.viscosity, settings.density, kernel_) * dt;
  std::vector<double> held(size(), 0);
  Field& v = state.velocity;
  Field residual = viscousForce(c, v);
  const std::vector<Pose> solids = poses(time_ - dt, dt);
  for (const Adhesion& a : adhesions(solids, c, false)) {
    held[a.particle] += a.strength;
    const Double3 surface = velocityAt(solids[a.solid], {a.at.x, a.at.y, a.at.z});
    residual[a.particle] += a.strength * (a.reverse * vec(surface) - v[a.particle]);
  }
  const auto applied = [&](const Field& of) {
    Field all = sum(of, -1, viscousForce(c, of));
    for (size_t i = 0; i < size(); ++i) all[i] += held[i] * of[i];
    return all;
  };
  if (settings.viscositySteps > 0) {
    const shared::ViscositySteps steps = shared::viscositySteps(viscosityBound(c, held), static_cast<uint32_t>(settings.viscositySteps));
    Field direction = sum(Field(size(), glm::dvec3(0)), 1 / steps.center, residual);
    add(1, direction);
    for (uint32_t k = 1; k < steps.count; ++k) {
      residual = sum(residual, -1, applied(direction));
      const double ratio = shared::chebyshevRatio(steps.decay, k);
      for (glm::dvec3& d : direction) d *= ratio * shared::chebyshevRatio(steps.decay, k - 1);
      direction = sum(direction, 2 * ratio / steps.halfWidth, residual);
      add(1, direction);
    }
  } else {
    // Of momenta and velocities, in which the system is symmetric.
    const auto dot = [&](const Field& a, const Field& b) {
      double all = 0;
      for (size_t i = 0; i < size(); ++i) all += glm::dot(a[i], b[i]) / inverseMass(i);
      return all;
    };
    const double enough = 1e-28 * dot(residual, residual);
    Field direction = residual;
    for (double before = dot(residual, residual); before > enough;) {
      const Field along = applied(direction);
      const double step = before / dot(direction, along);
      add(step, direction);
      residual = sum(residual, -step, along);
      const double after = dot(residual, residual);
      direction = sum(residual, after / before, direction);
      before = after;
    }
  }
  if (std::ranges::find(settings.solids, false, &Solid::slip) != settings.solids.end()) noSlip(c, dt);
}

}  // namespace rill::reference
