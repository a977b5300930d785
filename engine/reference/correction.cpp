// From multipliers to velocities: the correction of positions, and what of it counts as speed.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "reference/solver.hpp"
#include "shared/body_records.h"
#include "sph/background_pressure.hpp"

namespace rill::reference {

double ReferenceSolver::artificialPressureTerm(double value, double push) const {
  return push == 0 ? 0 : -push / kernel_.restGradientSum() * artificial_.factor(value);
}

glm::dvec3 ReferenceSolver::ownGradient(size_t i) const {
  const glm::dvec3 displaced = vec(boundary_[i].gradient);
  glm::dvec3 sum = displaced;
  for (const Pair& pair : pairs(i)) sum += pair.gradient;
  const Double3& coverage = boundary_[i].coverage;  // by solids: beside mouths alone the fluid goes on
  if (coverage.x + coverage.y + coverage.z > 0) sum = alongSurface(sum, displaced, settings.spacing);
  return displaced - backgroundShare_[i] * backgroundFactor(glm::length(sum) * settings.spacing) * sum;
}

void ReferenceSolver::correction(double dt, double push) {
  push_ = push;
  const std::vector<Pose> solids = poses(time_, dt);
  const AddReaction add = addTo(impulses_, solids, 1 / dt);
  addContributions(dt, {});  // of the iteration before
  for (size_t i = 0; i < size(); ++i) rejectedBefore_[i] += std::exchange(rejected_[i], glm::dvec3(0));
  gaveWay_.assign(size(), false);
  pushedOut_.assign(size(), 0);
  for (size_t i = 0; i < size(); ++i) {
    const AddReaction later = [&](size_t n, const glm::dvec3& by, const glm::dvec3& at) { contributions_.push_back({i, n, by, at}); };
    glm::dvec3 sum(0), apart(0);
    for (const Pair& pair : pairs(i)) {
      const double artificial = artificialPressureTerm(pair.value, push) / std::max(inverseMass(i), inverseMass(pair.j));
      sum += (lambdaChange_[i] + lambdaChange_[pair.j] + artificial) * (pairScale(i, pair) * pair.gradient);
      apart += kCoincidentDistance * kernel_.h() * pair.apart;
    }
    addReactions(i, lambdaChange_[i], solids, later);
    const glm::dvec3 moved = state.predicted[i] + inverseMass(i) * (sum + lambdaChange_[i] * ownGradient(i)) + apart;
    gain_[i] = glm::dvec3(0);
    if (finite(moved)) {
      wallPosition_[i] = collide(moved, {});
      gain_[i] = wallPosition_[i] - state.predicted[i];
      state.predicted[i] = collide(moved, solids, [&](size_t n, const glm::dvec3& by, const glm::dvec3& at) {
        const double share = bodies_.share(n, at, glm::normalize(by));
        gaveWay_[i] = gaveWay_[i] || share < kFirmShare;
        rejected_[i] += (1 - share) * by;
        if (!bodies_.isBody(n)) pushedOut_[i] += glm::length(by);
        add(n, share / inverseMass(i) * by, at);
      });
    } else {
      deactivate(i);
    }
  }
}

double ReferenceSolver::keptPush(const glm::dvec3& moved, const glm::dvec3& push, double most) {
  const double length = glm::length(push);
  return length > 0 ? std::min(1.0, (std::max(0.0, -glm::dot(moved, push) / length) + most) / length) : 1;
}

void ReferenceSolver::velocities(double dt) {
  const std::vector<Pose> solids = poses(time_, dt), before = poses(time_, 0);
  const double maxGain = dt * (std::clamp(std::max(0.5 * std::max(fastest_, emitterSpeed()), 5 * bodies_.fastest()), settings.minSpeedGain,
                                          settings.maxSpeedGain) +
                               4 * dt * glm::length(settings.gravity));
  const double maxPush = maxGain + dt * settings.solidSpeed, maxPushOut = std::max(maxPush, maxGain + dt * bodies_.fastest());
  const AddReaction add = addTo(impulses_, solids, 1 / dt);
  std::vector<double> kept(size(), 1);
  fastest_ = squares_ = 0;  // exclude solids, as in the shaders
  if (settings.shearViscosity) prior_ = state.velocity;
  for (size_t i = 0; i < size(); ++i) {
    const double gain = glm::length(gain_[i]);
    kept[i] = gain > maxGain ? maxGain / gain : 1;
    const double removed = 1 - kept[i];
    const glm::dvec3 pushed = wallPosition_[i] - gain_[i] - state.position[i] - planned_[i] - rejectedBefore_[i];
    const glm::dvec3 predicted = planned_[i] + keptPush(planned_[i], pushed, maxPush) * pushed;
    const glm::dvec3 free = (1 - 0.5 * removed) * predicted + kept[i] * gain_[i];
    if (finite(wallPosition_[i])) addSpeed(glm::length(free) / dt);
    moveAlongSurface(i, solids, before, add);
    const glm::dvec3 out = state.predicted[i] - wallPosition_[i] - rejected_[i];
    glm::dvec3 v = contact(i, (free + (gaveWay_[i] ? 1 : keptPush(free, out, maxPushOut)) * out) / dt, dt, solids, add);
    const double speed = glm::length(v);
    if (speed > settings.speedLimit) v *= settings.speedLimit / speed;
    if (finite(v)) {
      state.position[i] = state.predicted[i];
      state.velocity[i] = v;
    } else {
      deactivate(i);
    }
  }
  addContributions(dt, kept);
  moveBodies(dt);
  bodies_.end(dt);
  time_ += dt;
  step_ = 0;
}

// `kept`: a factor for each particle; empty: 1.
void ReferenceSolver::addContributions(double dt, std::span<const double> kept) {
  const AddReaction add = addTo(impulses_, densityPoses_, 1 / dt);
  for (const Contribution& c : std::exchange(contributions_, {}))
    add(c.solid, (kept.empty() ? 1 : kept[c.particle]) * c.displacement, c.at);
}

void ReferenceSolver::moveBodies(double dt) {
  if (!bodies_.any()) return;
  std::vector<Impulse> since = impulses_;
  for (size_t n = 0; n < since.size(); ++n) {
    since[n].linear -= applied_[n].linear;
    since[n].angular -= applied_[n].angular;
  }
  applied_ = impulses_;
  bodies_.react(since, dt);
}

}  // namespace rill::reference
