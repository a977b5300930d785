// Walls and solids: density contribution, collisions, contact.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "reference/solver.hpp"
#include "shared/fluid_records.h"

namespace rill::reference {

std::vector<Pose> ReferenceSolver::poses(double t, double dt) const {
  std::vector<Pose> all;
  for (const Solid& solid : settings.solids) {
    Pose pose = dt > 0 ? solidPose(solid, t, dt) : solidPose(solid, t);
    for (glm::length_t a = 0; a < 3; ++a) pose.center[a] -= settings.origin[a];
    all.push_back(pose);
  }
  return all;
}

WallSample ReferenceSolver::boundaryAt(const glm::dvec3& x, double t) const { return boundaryOf(x, poses(t, 0)); }

WallSample ReferenceSolver::boundaryOf(const glm::dvec3& x, std::span<const Pose> solids) const {
  Double3 lo, hi;
  for (int a = 0; a < 3; ++a) lo[a] = x[a] - settings.lo[a], hi[a] = settings.hi[a] - x[a];
  WallSample sum = settings.tabulated ? tables_.sample(lo, hi) : exactWall(kernel_, lo, hi);
  for (size_t n = 0; n < solids.size(); ++n) {
    const Shape& shape = settings.solids[n].shape;
    const Double3 local = localPoint(solids[n], {x.x, x.y, x.z});
    const WallSample own = settings.tabulated ? solidSample(tables_, sphereTables_[n], shape, local) : solidSample(kernel_, shape, local);
    const Double3 gradient = toScene(solids[n], own.gradient);
    sum.value += own.value;
    for (size_t a = 0; a < 3; ++a) sum.gradient[a] += gradient[a];
    sum.cover(own.value, gradient);
  }
  return sum;
}

glm::dmat3 ReferenceSolver::tangentialScale(size_t i) const {
  const WallScale s = wallScale(boundary_[i]);
  return {s.diagonal[0], s.mixed[2], s.mixed[1], s.mixed[2], s.diagonal[1], s.mixed[0], s.mixed[1], s.mixed[0], s.diagonal[2]};
}

/// Moves a center to half a spacing from every surface that is closer: solids in order, walls last, so that no particle ends outside.
/// Between walls that are less than a spacing apart it is moved to the middle.
glm::dvec3 ReferenceSolver::collide(glm::dvec3 x, std::span<const Pose> solids) const {
  const double clearance = settings.spacing / 2;
  for (size_t n = 0; n < solids.size(); ++n) {
    const SurfacePoint surface = surfaceAt(settings.solids[n].shape, solids[n], {x.x, x.y, x.z});
    if (surface.distance < clearance) x += (clearance - surface.distance) * vec(surface.normal);
  }
  for (int a = 0; a < 3; ++a) {
    const double lo = settings.lo[a] + clearance, hi = settings.hi[a] - clearance;
    x[a] = lo > hi ? (lo + hi) / 2 : std::clamp(x[a], lo, hi);
  }
  return x;
}

/// Velocity after contact with solids, with restitution e and Coulomb friction mu, relative to the velocity of the solid. With the velocity
/// before the solve, u = v_old + g dt - v_solid, and the contribution of the neighbors' pressure, f = a_i sum_j (lambda_i + lambda_j) G_ij
/// / dt:
///   v_n >= -e u_n if u_n < 0;   the tangential speed is reduced by at most mu max(0, v_n - u_n - f_n), the impulse of the solid.
/// The term f makes friction include the weight of the column above. Domain walls have e = 0 and mu = 0.
glm::dvec3 ReferenceSolver::contact(size_t i, glm::dvec3 v, double dt, std::span<const Pose> solids) const {
  const glm::dvec3& x = state.predicted[i];
  for (size_t k = 0; k < solids.size(); ++k) {
    const double restitution = settings.solids[k].restitution, friction = settings.solids[k].friction;
    if (restitution <= 0 && friction <= 0) continue;
    const SurfacePoint surface = surfaceAt(settings.solids[k].shape, solids[k], {x.x, x.y, x.z});
    if (surface.distance > kContactDistance * settings.spacing) continue;
    const glm::dvec3 n = vec(surface.normal);
    const glm::dvec3 solid = vec(velocityAt(solids[k], {x.x, x.y, x.z}));
    const double before = glm::dot(state.velocity[i] + dt * settings.gravity - solid, n);
    const glm::dvec3 relative = v - solid;
    double normal = glm::dot(relative, n);
    glm::dvec3 tangential = relative - normal * n;
    if (before < 0 && restitution > 0) normal = std::max(normal, -restitution * before);
    glm::dvec3 pressure(0);
    for (const Pair& pair : pairs(i)) pressure += (lambda_[i] + lambda_[pair.j]) / dt * pair.gradient;
    const double impulse = std::max(0.0, normal - before - glm::dot(tangentialScale(i) * pressure, n));
    const double slip = glm::length(tangential);
    if (slip > 0) tangential *= std::max(0.0, 1 - friction * impulse / slip);
    v = solid + normal * n + tangential;
  }
  return v;
}

}  // namespace rill::reference
