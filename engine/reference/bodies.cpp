#include "reference/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "fluid/settings.hpp"
#include "shape/mass.hpp"

namespace rill::reference {
namespace {

/// 1 along the axes that are free of three bits of a mask.
glm::dvec3 freeAxes(unsigned locked) {
  glm::dvec3 axes(0);
  for (int a = 0; a < 3; ++a) axes[a] = (locked >> a & 1U) == 0 ? 1 : 0;
  return axes;
}

glm::dquat turned(const glm::dquat& q, const glm::dvec3& turn) {
  const double angle = glm::length(turn);
  return angle > 0 ? glm::normalize(glm::angleAxis(angle, turn / angle) * q) : q;
}

}  // namespace

Bodies::Bodies(const std::vector<Solid>& solids, const glm::dvec3& origin, const Walls& walls, double spacing, double separationSpeed)
    : solids_(solids), walls_(walls), spacing_(spacing), separationSpeed_(separationSpeed), indexOf_(solids.size(), -1) {
  for (size_t n = 0; n < solids.size(); ++n) {
    const Solid& solid = solids[n];
    if (!solid.body) continue;
    indexOf_[n] = static_cast<int>(bodies_.size());
    const MassProperties m = massOf(solid);
    const Pose pose = solidPose(solid, 0);
    const auto& i = m.inertia;
    RigidBody body{.solid = n,
                   .mass = m.mass,
                   .from = solid.body->from,
                   .radius = radiusAbout(solid.shape, m.center),
                   .offset = vec(m.center),
                   .inertia = {i[0], i[5], i[4], i[5], i[1], i[3], i[4], i[3], i[2]},
                   .locked = solid.body->locked,
                   .points = contactPoints(solid.shape),
                   .held = solid.body->from > 0};
    body.slips.resize(body.points.size());
    body.state.rotation = {pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z};
    body.state.center = vec(pose.center) + body.state.rotation * body.offset - origin;
    body.state.velocity = vec(solid.body->velocity);
    body.state.angularVelocity = vec(solid.body->angular_velocity);
    body.predicted = body.state;
    bodies_.push_back(std::move(body));
  }
  findFastest();
}

void Bodies::findFastest() {
  fastest_ = 0;
  for (const RigidBody& body : bodies_)
    fastest_ = std::max(
        fastest_, glm::length(body.state.velocity) + boundingRadius(solids_[body.solid].shape) * glm::length(body.state.angularVelocity));
}

Pose Bodies::poseOf(const RigidBody& body, const BodyMotion& m) const {
  const glm::dvec3 toCenter = -(m.rotation * body.offset), center = m.center + toCenter,
                   velocity = m.velocity + glm::cross(m.angularVelocity, toCenter);
  return {.center = triple(center),
          .rotation = {m.rotation.x, m.rotation.y, m.rotation.z, m.rotation.w},
          .velocity = triple(velocity),
          .angularVelocity = triple(m.angularVelocity)};
}

Pose Bodies::poseOf(size_t solid) const { return poseOf(bodies_[index(solid)], bodies_[index(solid)].predicted); }

Impulse Bodies::aboutMass(const RigidBody& body, const Impulse& impulse) const {
  return {impulse.linear, impulse.angular - glm::cross(body.predicted.rotation * body.offset, impulse.linear)};
}

namespace {

/// Without the rotations that are locked.
glm::dmat3 inverseInertia(const glm::dmat3& inertia, FreedomMask locked) {
  const glm::dvec3 turns = freeAxes(locked >> 3U);
  glm::dmat3 kept(1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) kept[i][j] = turns[i] * turns[j] * inertia[i][j] + (i == j ? 1 - turns[i] : 0);
  glm::dmat3 inverted = glm::inverse(kept);
  for (int i = 0; i < 3; ++i) inverted[i] *= turns[i] * turns;
  return inverted;
}

glm::dmat3 inertiaAt(const glm::dmat3& inertia, const glm::dquat& rotation) {
  const glm::dmat3 r = glm::mat3_cast(rotation);
  return r * inertia * glm::transpose(r);
}

}  // namespace

// `impulse`: times dt, about the center of mass.
void Bodies::push(RigidBody& body, const Impulse& impulse, double dt) {
  BodyMotion& m = body.predicted;
  const glm::dvec3 by = freeAxes(body.locked) * impulse.linear / body.mass,
                   turn = inverseInertia(inertiaAt(body.inertia, m.rotation), body.locked) * impulse.angular;
  m.center += by;
  m.rotation = turned(m.rotation, turn);
  m.velocity += by / dt;
  m.angularVelocity += turn / dt;
}

double Bodies::mobility(const RigidBody& body, const glm::dvec3& at, const glm::dvec3& direction) const {
  const glm::dvec3 turn = glm::cross(at - body.predicted.center, direction);
  return glm::dot(direction, freeAxes(body.locked) * direction) / body.mass +
         glm::dot(turn, inverseInertia(inertiaAt(body.inertia, body.predicted.rotation), body.locked) * turn);
}

// The spring's force is that at the end of the step: j = -m h (w^2 (C + h u) + 2 z w u), u = v + K j.
void Bodies::applyPull(const Pull& pull, const RigidBody& body, double dt, glm::dvec3& velocity, glm::dvec3& momentum) const {
  const BodyMotion& m = body.predicted;
  const glm::dmat3 inverse = inverseInertia(inertiaAt(body.inertia, m.rotation), body.locked);
  const glm::dvec3 r = m.rotation * (pull.point - body.offset), offset = m.center + r - pull.target;
  glm::dmat3 mobile(0);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 axis(0);
    axis[i] = 1;
    mobile[i] = freeAxes(body.locked) * axis / body.mass + glm::cross(inverse * glm::cross(r, axis), r);
  }
  const double stiffness = body.mass * pull.rate * pull.rate, damping = 2 * body.mass * pull.dampingRatio * pull.rate;
  const double softness = dt * (damping + dt * stiffness);
  const glm::dvec3 v = velocity + glm::cross(inverse * momentum, r);
  glm::dvec3 j = glm::inverse(glm::dmat3(1) + softness * mobile) * -(dt * stiffness * offset + softness * v);
  if (const double size = glm::length(j); size > dt * pull.maxForce) j *= dt * pull.maxForce / size;
  velocity += freeAxes(body.locked) * j / body.mass;
  momentum += glm::cross(r, j);
}

void Bodies::predict(double time, double dt, const glm::dvec3& gravity, std::span<const Impulse> warm, std::span<const Pull> pulls,
                     std::vector<Pose> poses, bool atRest, Surface surface) {
  surface_ = std::move(surface);
  for (RigidBody& body : bodies_) {
    body.held = time < body.from;
    body.predicted = body.state;
    BodyMotion& m = body.predicted;
    if (atRest || body.held) m.velocity = m.angularVelocity = glm::dvec3(0);
    if (body.held) continue;
    const Impulse impulse = aboutMass(body, warm[body.solid]);
    m.velocity += freeAxes(body.locked) * (dt * gravity + impulse.linear / body.mass);
    glm::dvec3 momentum = inertiaAt(body.inertia, m.rotation) * m.angularVelocity + impulse.angular;
    for (const Pull& pull : pulls)
      if (pull.solid == body.solid && !atRest) applyPull(pull, body, dt, m.velocity, momentum);
    const auto turning = [&](const glm::dquat& q) { return inverseInertia(inertiaAt(body.inertia, q), body.locked) * momentum; };
    const glm::dvec3 halfway = turning(turned(m.rotation, 0.5 * dt * turning(m.rotation)));
    m.center += dt * m.velocity;
    m.rotation = turned(m.rotation, dt * halfway);
    m.angularVelocity = turning(m.rotation);
  }
  atRest_ = atRest;
  poses_ = std::move(poses);
  for (const RigidBody& body : bodies_) poses_[body.solid] = poseOf(body, body.predicted);
  findTouched();
  countContacts(dt);
  for (uint32_t iteration = 0; iteration < contactIterations(bodies_.size()); ++iteration)
    solveContacts(dt, glm::length(gravity), iteration == 0);
  surface_ = {};
}

void Bodies::react(std::span<const Impulse> solve, double dt) {
  for (RigidBody& body : bodies_) {
    if (body.held) continue;
    const Impulse impulse = aboutMass(body, solve[body.solid]);
    push(body, {dt * impulse.linear, dt * impulse.angular}, dt);
  }
}

void Bodies::end(double dt) {
  for (RigidBody& body : bodies_) {
    for (int a = 0; a < 3; ++a)  // the solve carries no center through a wall
      if (body.state.center[a] >= walls_.lo[a] && body.state.center[a] <= walls_.hi[a])
        body.predicted.center[a] = std::clamp(body.predicted.center[a], walls_.lo[a], walls_.hi[a]);
    body.state = body.predicted;
    body.stiffness = body.nextStiffness;
  }
  findFastest();
  lastStep_ = dt;
  advanced_ = true;
}

Pose Bodies::stuckPose(size_t solid, std::span<const Held> particles) const {
  constexpr size_t kFreedoms = 6;
  const RigidBody& body = bodies_[index(solid)];
  const glm::dmat3 inertia = inertiaAt(body.inertia, body.state.rotation);
  // A point at r from the center of mass moves by turns[a] x r, or along an axis, for a unit of each degree of freedom.
  std::array<std::array<double, kFreedoms + 1>, kFreedoms> rows{};
  for (int a = 0; a < 3; ++a) {
    rows[static_cast<size_t>(a)][static_cast<size_t>(a)] = body.mass;
    for (int b = 0; b < 3; ++b) rows[static_cast<size_t>(3 + a)][static_cast<size_t>(3 + b)] = inertia[a][b];
  }
  for (const Held& p : particles) {
    if (p.solid != solid) continue;
    std::array<glm::dvec3, kFreedoms + 1> moved;
    for (int a = 0; a < 3; ++a) {
      glm::dvec3 axis(0);
      axis[a] = 1;
      moved[static_cast<size_t>(a)] = axis;
      moved[static_cast<size_t>(3 + a)] = glm::cross(axis, p.at - body.state.center);
    }
    moved[kFreedoms] = p.relative;
    for (size_t a = 0; a < kFreedoms; ++a)
      for (size_t b = 0; b <= kFreedoms; ++b) rows[a][b] += p.mass * glm::dot(moved[a], moved[b]);
  }
  for (size_t a = 0; a < kFreedoms; ++a) {
    if ((body.locked >> a & 1U) == 0) continue;
    for (size_t b = 0; b <= kFreedoms; ++b) rows[a][b] = b == a ? 1 : 0;
    for (size_t b = 0; b < kFreedoms; ++b) rows[b][a] = b == a ? 1 : 0;
  }
  for (size_t a = 0; a < kFreedoms; ++a)  // positive definite: no pivot is 0
    for (size_t b = 0; b < kFreedoms; ++b) {
      if (a == b) continue;
      const double factor = rows[b][a] / rows[a][a];
      for (size_t c = 0; c <= kFreedoms; ++c) rows[b][c] -= factor * rows[a][c];
    }
  BodyMotion changed = body.state;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<size_t>(a);
    changed.velocity[a] += rows[n][kFreedoms] / rows[n][n];
    changed.angularVelocity[a] += rows[n + 3][kFreedoms] / rows[n + 3][n + 3];
  }
  return poseOf(body, changed);
}

void Bodies::accelerate(std::span<const Impulse> impulses) {
  const double before = fastest_;
  for (RigidBody& body : bodies_) {
    if (body.held) continue;
    const Impulse impulse = aboutMass(body, impulses[body.solid]);
    body.state.velocity += freeAxes(body.locked) * impulse.linear / body.mass;
    body.state.angularVelocity += inverseInertia(inertiaAt(body.inertia, body.state.rotation), body.locked) * impulse.angular;
    body.predicted = body.state;
  }
  findFastest();
  fastest_ = std::max(fastest_, before);
}

void Bodies::forgetPrediction() {
  for (RigidBody& body : bodies_) {
    body.predicted = body.state;
    body.stiffness = body.nextStiffness;
  }
}

double Bodies::root(size_t solid, const glm::dvec3& x, const glm::dvec3& gradient) const {
  if (!isBody(solid)) return 0;
  return std::sqrt(mobility(bodies_[index(solid)], x, gradient));
}

void Bodies::beginStiffness() {
  for (RigidBody& body : bodies_) body.nextStiffness = 0;
}

void Bodies::addRoot(size_t solid, double root, double particleMass) {
  if (isBody(solid)) bodies_[index(solid)].nextStiffness += particleMass * root;
}

double Bodies::share(size_t solid, const glm::dvec3& x, const glm::dvec3& direction) const {
  if (!isFree(solid)) return 1;
  return 1 / (1 + 2 * spacing_ * root(solid, x, direction) * stiffness(solid));
}

}  // namespace rill::reference
