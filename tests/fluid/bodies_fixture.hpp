#pragma once
// Scenes with rigid bodies, and their comparison with the reference.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "fluid/rig.hpp"
#include "shape/mass.hpp"
#include "shape/shape.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace bodies_test {

using reference::vec;
inline glm::dquat quat(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

inline Solid body(Solid solid, double density, glm::dvec3 velocity = glm::dvec3(0)) {
  solid.friction = 0.4;
  solid.body = Body{.density = density, .velocity = {velocity.x, velocity.y, velocity.z}};
  return solid;
}

inline Solid turned(Solid solid, glm::dvec3 axis, double angle) {
  const glm::dquat q = glm::angleAxis(angle, glm::normalize(axis));
  solid.rotation = {q.x, q.y, q.z, q.w};
  return solid;
}

inline Solid crate(glm::dvec3 center, double edge, double density = 500) {
  return body(slab(center - glm::dvec3(edge / 2), center + glm::dvec3(edge / 2)), density);
}

/// A ball whose origin is off its center.
inline Solid eccentricBall(glm::dvec3 center, double radius) {
  MeshData data = ballMesh(radius, 3);
  const Double3 off = {0.3, -0.1, 0.05};
  for (Double3& vertex : data.vertices)
    for (size_t a = 0; a < 3; ++a) vertex[a] += off[a];
  return {.shape = MeshShape{.mesh = meshOf(data)}, .translation = {center.x - off.x, center.y - off.y, center.z - off.z}};
}

/// Fluid under gravity around a light box that is turned, a heavy ball and a mesh, none of which touches another.
inline Trial crowded() {
  Trial t = trial();
  setWalls(t, {1.2, 1.2, 0.8});
  t.scene.solids = {turned(body(slab({0.15, 0.2, 0.2}, {0.4, 0.35, 0.5}), 300), {0, 0, 1}, 0.4), body(ball({0.7, 0.3, 0.4}, 0.12), 3000),
                    body(eccentricBall({1.0, 0.5, 0.4}, 0.12), 800)};
  addOutsideSolids(t, block({19, 10, 12}, t.d(), {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {1, -1.5, 0.75});
  return t;
}

/// Without fluid: bodies that fall on a slab, on the floor and on each other.
inline Trial dry() {
  Trial t = trial();
  setWalls(t, {2, 2, 2});
  t.capacity = 1;
  Solid ramp = turned(slab({0.2, 0.2, 0.2}, {1.2, 0.3, 1}), {0, 0, 1}, 0.3);
  ramp.friction = 0.5;
  Solid bouncing = body(ball({0.9, 1.0, 0.6}, 0.15), 800, {0, -1, 0});
  bouncing.restitution = 0.6;
  t.scene.solids = {ramp, turned(crate({0.6, 0.75, 0.6}, 0.3), {1, 2, 3}, 0.5), bouncing, crate({1.6, 0.2, 0.5}, 0.4),
                    turned(crate({1.65, 0.62, 0.5}, 0.3), {0, 1, 0}, 0.3)};
  return t;
}

class BodiesTest : public FluidTest {
 protected:
  /// A pass of a second at a step of 1e-3 s would exceed max_substeps.
  void runFor(Run& run, double seconds) {
    const int advances = static_cast<int>(std::ceil(seconds / 0.1));
    for (int n = 0; n < advances; ++n) run.advance(seconds / advances);
    run.read({});
  }
  BodyMotion motion(Run& run, size_t solid) { return *std::ranges::find(run.fluid().bodies(), solid, &BodyMotion::solid); }

  /// `limit`: spacings, and spacings a substep.
  void expectReferenceMotion(const Trial& t, int substeps, double limit) {
    Oracle oracle(t);
    oracle.advance(substeps);
    forEachGather(t, substeps, [&](Run& run) {
      run.read({});
      double moved = 0;
      for (size_t n = 0; n < t.scene.solids.size(); ++n) {
        if (!t.scene.solids[n].body) continue;
        const BodyMotion m = motion(run, n);
        const reference::BodyMotion& exact = oracle.solver().bodies().motion(n);
        const double unit = limit * t.d(), radius = boundingRadius(t.scene.solids[n].shape);
        EXPECT_LT(glm::length(vec(m.center) - exact.center - vec(t.origin)), unit) << n;
        EXPECT_LT(glm::length(vec(m.velocity) - exact.velocity) * t.step, unit) << n;
        EXPECT_LT(glm::length(vec(m.angularVelocity) - exact.angularVelocity) * radius * t.step, unit) << n;
        EXPECT_GT(std::abs(glm::dot(quat(m.rotation), exact.rotation)), 1 - std::max(limit * limit, 1e-6)) << n;
        moved = std::max(moved, glm::length(exact.velocity - vec(t.scene.solids[n].body->velocity)));
      }
      EXPECT_GT(moved, 0.01) << "the trial moves no body";
    });
  }
};

/// Six crates, three, two and one, with gaps between neighbors.
inline Trial pyramid() {
  Trial t = trial();
  t.capacity = 1;
  setWalls(t, {2, 2, 1});
  for (int level = 0; level < 3; ++level)
    for (int k = 0; k < 3 - level; ++k) t.scene.solids.push_back(crate({0.5 + 0.31 * k + 0.155 * level, 0.15 + 0.3 * level, 0.5}, 0.3));
  t.step = 2e-3;
  return t;
}

}  // namespace bodies_test
}  // namespace rill::test
