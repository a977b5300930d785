// Viscosity as an implicit step, (1 + dt L) v' = v, with L v = -f(v) of sph/viscosity.hpp. Where shear changes viscosities it starts
// from the velocities before the substep, which a fluid that creeps nearly keeps.
#include "sph/viscosity.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "reference/solver.hpp"
#include "shared/shear_viscosity.h"
#include "shared/viscosity_steps.h"
#include "sph/shear_viscosity.hpp"

namespace rill::reference {
namespace {

using Field = std::vector<glm::dvec3>;

/// a + factor b.
Field sum(const Field& a, double factor, const Field& b) {
  Field all = a;
  for (size_t i = 0; i < a.size(); ++i) all[i] += factor * b[i];
  return all;
}

double trace(const glm::dmat3& m) { return m[0].x + m[1].y + m[2].z; }

double largestRow(const glm::dmat3& m) {
  double largest = 0;
  for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(m[a].x) + std::abs(m[a].y) + std::abs(m[a].z));
  return largest;
}

}  // namespace

double ReferenceSolver::pairViscosity(size_t i, size_t j) const {
  if (settings.fluids.empty()) return 1;
  const auto of = [&](size_t k) {
    return settings.shearViscosity ? shearViscosity_[k] : settings.fluids[state.fluid[k]].viscosity / settings.viscosity;
  };
  const double own = of(i), other = of(j);
  return own > 0 && other > 0 ? 2 / (1 / own + 1 / other) : 0;
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
    bound = std::max(bound, 1 + 2 * c * largestRow(own) + held[i]);
  }
  return bound;
}

// That of the linear flow which fits the neighbors, without its divergence; noise of velocities hardly changes it. Where too few neighbors
// lie in a plane or on a line rigid motion would have a rate, but has none by that of the pairs: in a linear flow (q . (v_j - v_i))^2 is
// 2/15 h^2 q^4 D : D on average over all directions, or over a half of them.
double ReferenceSolver::shearRate(size_t i, const Field& v) const {
  double squares = 0, moment = 0;
  glm::dmat3 places(0), slopes(0);
  for (const Pair& pair : pairs(i)) {
    if (state.fluid[pair.j] != state.fluid[i]) continue;
    const glm::dvec3 image = settings.noSlipWalls ? pair.sign.x * pair.sign.y * pair.sign.z * pair.sign : pair.sign;
    const glm::dvec3 q = pair.offset / kernel_.h(), difference = image * v[pair.j] - v[i];
    const double weight = pairWeight(glm::length(q)), along = glm::dot(q, difference);
    squares += weight * along * along;
    moment += weight * glm::dot(q, q) * glm::dot(q, q);
    places += weight * glm::outerProduct(q, q);
    slopes += weight * glm::outerProduct(difference, q);
  }
  const double ofPairs = std::sqrt(15 * squares / std::max(moment, 1e-20)) / kernel_.h();
  places += glm::dmat3(std::max(1e-3 * trace(places), 1e-9));
  const glm::dmat3 flow = slopes * glm::inverse(places), strain = 0.5 * (flow + glm::transpose(flow)) - glm::dmat3(trace(flow) / 3);
  double square = 0;
  for (int a = 0; a < 3; ++a) square += 2 * glm::dot(strain[a], strain[a]);
  return std::min(kShearOfPairs * ofPairs, std::sqrt(square) / kernel_.h());
}

// No more than what the steps of the solve reach.
std::vector<double> ReferenceSolver::shearViscosities(double c) {
  std::vector<double> all(size());
  viscosityCapped_ = 0;
  for (size_t i = 0; i < size(); ++i) {
    const ReferenceFluid& fluid = settings.fluids[state.fluid[i]];
    all[i] = viscosityAt({fluid.viscosity, fluid.yieldStress, fluid.flowIndex}, shearRate(i, prior_)) / settings.viscosity;
    glm::dmat3 own(0);
    double moment = 0;
    for (const Pair& pair : pairs(i)) {
      const glm::dvec3 q = pair.offset / kernel_.h();
      const ReferenceFluid& other = settings.fluids[state.fluid[pair.j]];
      if (other.viscosity > 0 || other.yieldStress > 0) moment += pairWeight(glm::length(q)) * glm::dot(q, q) * glm::dot(q, q);
      if (state.fluid[pair.j] == state.fluid[i]) own += pairWeight(glm::length(q)) * glm::outerProduct(q, q);
    }
    // At a surface, and in a liquid, sums are less than in the lattice. Solids count with the density that they displace.
    const double whole = moment / pairMoment(kernel_, 4) + boundary_[i].value;
    const bool changes = fluid.yieldStress > 0 || fluid.flowIndex != 1;
    if (changes && whole > 0) all[i] *= std::clamp(1 / whole, 1.0, double{kShearGain});
    const double row = 2 * c * inverseMass(i) * largestRow(own), room = (settings.shearBound - 1) / kShearMargin;
    if (row * all[i] <= room) continue;
    all[i] = room / row;
    ++viscosityCapped_;
  }
  return all;
}

// By Chebyshev's iteration with the steps of the shaders, or by conjugate gradients to rounding.
void ReferenceSolver::viscosity(double dt) {
  double c = viscosityRate(settings.viscosity, settings.density, kernel_) * dt;
  std::vector<double> held(size(), 0);
  Field& v = state.velocity;
  const Field free = v;
  if (settings.shearViscosity) {
    if (prior_.empty()) prior_ = v;  // a stage of its own
    shearViscosity_ = shearViscosities(c);
    v = std::exchange(prior_, {});
  }
  Field residual = viscousForce(c, v);
  const std::vector<Pose> solids = poses(time_ - dt, dt);
  for (const Adhesion& a : adhesions(solids, c, false)) {
    held[a.particle] += a.strength;
    const Double3 surface = velocityAt(solids[a.solid], {a.at.x, a.at.y, a.at.z});
    residual[a.particle] += a.strength * (a.reverse * vec(surface) - v[a.particle]);
  }
  // Momentum is kept only if the steps reach all eigenvalues.
  const double bound = settings.viscositySteps > 0 ? viscosityBound(c, held) : 1;
  const double scale = bound > settings.shearBound ? (settings.shearBound - 1) / (bound - 1) : 1, unscaled = c;
  c *= scale;
  for (double& each : held) each *= scale;
  if (settings.shearViscosity)
    for (size_t i = 0; i < size(); ++i) residual[i] = free[i] - v[i] + scale * residual[i];
  const auto applied = [&](const Field& of) {
    Field all = sum(of, -1, viscousForce(c, of));
    for (size_t i = 0; i < size(); ++i) all[i] += held[i] * of[i];
    return all;
  };
  if (settings.viscositySteps > 0) {
    const shared::ViscositySteps steps =
        shared::viscositySteps(std::min(bound, settings.shearBound), static_cast<uint32_t>(settings.viscositySteps));
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
  if (std::ranges::find(settings.solids, false, &Solid::slip) != settings.solids.end()) noSlip(unscaled, dt);
  if (!settings.shearViscosity) return;
  // Particles follow: else what stands would sink by what gravity adds to its speed in every substep.
  for (size_t i = 0; i < size(); ++i) {
    const glm::dvec3 along = dt * (v[i] - free[i]);
    const double longest = double{kShearDisplacement} * settings.spacing, length = glm::length(along);
    state.position[i] = collide(state.position[i] + (length > longest ? along * (longest / length) : along), {});
  }
}

}  // namespace rill::reference
