// Walls and solids: images, density contribution, collisions, contact.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "reference/mouths.hpp"
#include "reference/solver.hpp"
#include "shared/fluid_records.h"

namespace rill::reference {
namespace {

/// How much of a solid's image counts, which has the particle at `at`: of a solid that reaches through a wall the part behind it counts
/// itself, so that its image fades within a spacing.
double shareOfImage(const Shape& shape, const Pose& pose, const glm::dvec3& at, const Walls& walls, double spacing) {
  const SceneBox box = sceneBox(shape, pose);
  double share = 1;
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<size_t>(a);
    const double through = at[a] < walls.lo[a] ? walls.lo[a] - box.low[axis] : at[a] > walls.hi[a] ? box.high[axis] - walls.hi[a] : 0;
    share *= 1 - std::clamp(through / spacing, 0.0, 1.0);
  }
  return share;
}

}  // namespace

std::vector<Pose> ReferenceSolver::poses(double t, double dt) const {
  std::vector<Pose> all;
  for (const Solid& solid : settings.solids) {
    if (solid.body) {
      all.push_back(bodies_.poseOf(all.size()));
      continue;
    }
    Pose pose = dt > 0 ? solidPose(solid, t, dt) : solidPose(solid, t);
    for (glm::length_t a = 0; a < 3; ++a) pose.center[a] -= settings.origin[a];
    all.push_back(pose);
  }
  return all;
}

SolidSample ReferenceSolver::boundaryAt(const glm::dvec3& x, double t) const { return boundaryOf(x, poses(t, 0), t); }

SolidSample ReferenceSolver::boundaryOf(const glm::dvec3& x, std::span<const Pose> solids, double t) const {
  SolidSample sum;
  forEachSample(x, solids, [&](size_t, const SolidSample& own, const Image& image) {
    const glm::dvec3 gradient = image.sign * vec(own.gradient);
    sum.value += own.value;
    for (int a = 0; a < 3; ++a) sum.gradient[static_cast<size_t>(a)] += gradient[a];
    sum.cover(own.value, {gradient.x, gradient.y, gradient.z});
  });
  addMouths(x, t, sum);
  return sum;
}

void ReferenceSolver::addMouths(const glm::dvec3& x, double t, SolidSample& sample) const {
  if (settings.emitters.empty()) return;
  const auto halfSpaceAt = [this](double s) { return settings.tabulated ? halfSpace_.sample(s) : halfSpace(kernel_, s); };
  std::vector<Image> images = imagesNear(x, walls_, kernel_.h());
  images.insert(images.begin(), Image{});
  for (const EmitterSettings& emitter : settings.emitters) {
    SolidSample sum;
    for (const Image& image : images) {
      const SolidSample own = densityOfMouth(emitter, t, image.of(x), settings.spacing, halfSpaceAt);
      const double share = shareOfMouthImage(emitter, t, image.of(x), walls_, settings.spacing);
      const glm::dvec3 gradient = share * image.sign * vec(own.gradient);
      sum.value += share * own.value;
      for (int a = 0; a < 3; ++a) sum.gradient[static_cast<size_t>(a)] += gradient[a];
    }
    sample = unionOf(sample, sum);
  }
}

double ReferenceSolver::emitterSpeed() const {
  double fastest = 0;
  for (const EmitterSettings& emitter : settings.emitters)
    if (time_ < emitter.until) fastest = std::max(fastest, glm::length(emitter.velocity) + emitter.motionSpeed);
  return fastest;
}

void ReferenceSolver::keepMouthsFree(double dt) {
  for (size_t i = 0; i < size(); ++i)
    for (const EmitterSettings& emitter : settings.emitters) {
      const Push push = pushOutOfMouth(emitter, time_, state.position[i], state.velocity[i], settings.spacing, dt);
      if (push.displacement == glm::dvec3(0)) continue;
      state.position[i] = collide(state.position[i] + push.displacement, {});
      state.velocity[i] += push.velocity;
    }
}

void ReferenceSolver::forEachSample(const glm::dvec3& x, std::span<const Pose> solids,
                                    const std::function<void(size_t, const SolidSample&, const Image&)>& visit) const {
  if (solids.empty()) return;
  std::vector<Image> images = imagesNear(x, walls_, kernel_.h());
  images.insert(images.begin(), Image{});
  for (const Image& image : images) {
    const glm::dvec3 at = image.of(x);
    for (size_t n = 0; n < solids.size(); ++n) {
      const Shape& shape = settings.solids[n].shape;
      const Double3 local = localPoint(solids[n], {at.x, at.y, at.z});
      const SolidSample own = displacedBy(n, local);
      const double share = shareOfImage(shape, solids[n], at, walls_, settings.spacing);
      const glm::dvec3 gradient = share * vec(toScene(solids[n], own.gradient));
      visit(n, {.value = share * own.value, .gradient = {gradient.x, gradient.y, gradient.z}}, image);
    }
  }
}

void ReferenceSolver::addReactions(size_t i, double multiplier, std::span<const Pose> solids, const AddReaction& add) const {
  const glm::dvec3& x = boundaryPlace_[i];
  forEachSample(x, solids,
                [&](size_t n, const SolidSample& own, const Image& image) { add(n, multiplier * vec(own.gradient), image.of(x)); });
}

ReferenceSolver::AddReaction ReferenceSolver::addTo(std::vector<Impulse>& impulses, std::span<const Pose> solids, double factor) const {
  return [&impulses, solids, reaction = -mass() * factor](size_t n, const glm::dvec3& by, const glm::dvec3& at) {
    impulses[n].linear += reaction * by;
    impulses[n].angular += reaction * glm::cross(at - vec(solids[n].center), by);
  };
}

SolidSample ReferenceSolver::displacedBy(size_t solid, const Double3& local) const {
  if (solid < meshFields_.size() && meshFields_[solid]) return meshSample(halfSpace_, *meshFields_[solid], local);
  const Shape& shape = settings.solids[solid].shape;
  return settings.tabulated ? solidSample(halfSpace_, sphereTables_[solid], shape, local) : solidSample(kernel_, shape, local);
}

SurfacePoint ReferenceSolver::surfaceOf(size_t solid, const Pose& pose, const glm::dvec3& x) const {
  if (solid >= meshFields_.size() || !meshFields_[solid]) return surfaceAt(settings.solids[solid].shape, pose, {x.x, x.y, x.z});
  const MeshField::Sample sample = meshFields_[solid]->sample(localPoint(pose, {x.x, x.y, x.z}));
  const glm::dvec3 gradient = vec(toScene(pose, sample.gradient));
  const double slope = glm::length(gradient);
  const glm::dvec3 normal = slope > 1e-6 ? gradient / slope : vec(toScene(pose, {0, 1, 0}));
  return {sample.distance, {normal.x, normal.y, normal.z}};
}

void ReferenceSolver::addImages(uint32_t i, std::span<const uint32_t> neighbors) {
  const glm::dvec3 x = state.predicted[i];
  for (const Image& image : imagesNear(x, walls_, kernel_.h())) {
    const auto add = [&](uint32_t j) {
      const glm::dvec3 r = image.sign * (image.of(x) - state.predicted[j]);
      const double length = glm::length(r);
      if (length < kernel_.h()) pairs_.push_back({j, r, image.sign, kernel_.value(length), kernel_.gradientOverR(length) * r, {}});
    };
    add(i);
    for (const uint32_t j : neighbors) add(j);
  }
}

glm::dmat3 ReferenceSolver::tangentialScale(size_t i) const {
  const SolidScale s = solidScale(boundary_[i]);
  return {s.diagonal[0], s.mixed[2], s.mixed[1], s.mixed[2], s.diagonal[1], s.mixed[0], s.mixed[1], s.mixed[0], s.diagonal[2]};
}

glm::dmat3 ReferenceSolver::pairScale(size_t i, const Pair& pair) const {
  const glm::dmat3 one(1);
  if (scale_.empty()) return one;
  const glm::dmat3 own = scale_[i] - one, other = scale_[pair.j] - one;
  const glm::dmat3 mirror(pair.sign.x, 0, 0, 0, pair.sign.y, 0, 0, 0, pair.sign.z);
  return one + kScaleOfPair * (own + mirror * other * mirror);
}

/// Moves a center to half a spacing from every surface that is closer: solids in order, walls last, so that no particle ends outside.
/// Between walls that are less than a spacing apart it is moved to the middle.
glm::dvec3 ReferenceSolver::collide(glm::dvec3 x, std::span<const Pose> solids, const AddReaction& add, bool withBodies) const {
  const double clearance = settings.spacing / 2;
  for (size_t n = 0; n < solids.size(); ++n) {
    if (!withBodies && bodies_.isBody(n)) continue;
    const SurfacePoint surface = surfaceOf(n, solids[n], x);
    if (surface.distance >= clearance) continue;
    const glm::dvec3 by = (clearance - surface.distance) * vec(surface.normal);
    if (add) add(n, by, x);
    x += by;
  }
  for (int a = 0; a < 3; ++a) {
    const bool noLow = walls_.isOutflow(a, false, x), noHigh = walls_.isOutflow(a, true, x);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    const double lo = noLow ? -kFar : settings.lo[a] + clearance, hi = noHigh ? kFar : settings.hi[a] - clearance;
    x[a] = lo > hi ? (lo + hi) / 2 : std::clamp(x[a], lo, hi);
  }
  return x;
}

void ReferenceSolver::moveAlongSurface(size_t i, std::span<const Pose> solids, std::span<const Pose> before, const AddReaction& add) {
  const double pushed = predictionPush_[i] + pushedOut_[i];
  if (pushed <= 0 || !finite(state.predicted[i])) return;
  size_t nearest = solids.size();
  SurfacePoint surface{.distance = std::numeric_limits<double>::infinity()};
  for (size_t n = 0; n < solids.size(); ++n) {
    if (bodies_.isBody(n)) continue;
    const SurfacePoint found = surfaceOf(n, solids[n], state.predicted[i]);
    if (found.distance >= surface.distance) continue;
    surface = found;
    nearest = n;
  }
  if (nearest == solids.size()) return;
  const SurfacePoint start = surfaceOf(nearest, before[nearest], state.position[i]);
  if (start.distance > kContactDistance * settings.spacing) return;
  const glm::dvec3 normal = vec(surface.normal), startNormal = vec(start.normal);
  const glm::dvec3 by = pushed * (startNormal - glm::dot(startNormal, normal) * normal);
  add(nearest, by / inverseMass(i), state.predicted[i]);
  state.predicted[i] = collide(state.predicted[i] + by, {});
}

/// Velocity after contact with solids, with restitution e and Coulomb friction mu, relative to the velocity of the solid. With the velocity
/// before the solve, u = v_old + g dt - v_solid, and the contribution of the neighbors' pressure, f = sum_j a_ij (lambda_i + lambda_j) G_ij
/// / dt:
///   v_n >= -e u_n if u_n < 0;   the tangential speed is reduced by at most mu max(0, v_n - u_n - f_n), the impulse of the solid.
/// The term f makes friction include the weight of the column above. Domain walls have e = 0 and mu = 0.
glm::dvec3 ReferenceSolver::contact(size_t i, glm::dvec3 v, double dt, std::span<const Pose> solids, const AddReaction& add) const {
  const glm::dvec3& x = state.predicted[i];
  for (size_t k = 0; k < solids.size(); ++k) {
    const double restitution = settings.solids[k].restitution, friction = settings.solids[k].friction;
    if (restitution <= 0 && friction <= 0) continue;
    const SurfacePoint surface = surfaceOf(k, solids[k], x);
    if (surface.distance > kContactDistance * settings.spacing) continue;
    const glm::dvec3 n = vec(surface.normal);
    const glm::dvec3 solid = vec(velocityAt(solids[k], {x.x, x.y, x.z}));
    const double before = glm::dot(state.velocity[i] + dt * settings.gravity - solid, n);
    const glm::dvec3 relative = v - solid;
    double normal = glm::dot(relative, n);
    glm::dvec3 tangential = relative - normal * n;
    if (before < 0 && restitution > 0 && normal < -restitution * before)
      normal += bodies_.share(k, x, n) * (-restitution * before - normal);
    glm::dvec3 pressure = lambda_[i] * (ownGradient(i) - vec(boundary_[i].gradient));
    for (const Pair& pair : pairs(i)) pressure += (lambda_[i] + lambda_[pair.j]) * (pairScale(i, pair) * pair.gradient);
    const double impulse = std::max(0.0, normal - before - inverseMass(i) / dt * glm::dot(pressure, n));
    const double slip = glm::length(tangential);
    if (slip > 0) tangential *= 1 - bodies_.share(k, x, tangential / slip) * std::min(1.0, friction * impulse / slip);
    const glm::dvec3 after = solid + normal * n + tangential;
    add(k, dt / inverseMass(i) * (after - v), x);
    v = after;
  }
  return v;
}

}  // namespace rill::reference
