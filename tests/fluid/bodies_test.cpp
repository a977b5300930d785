// Rigid bodies: against the reference, against what mechanics says, and against input that is hard on contacts.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

#include "fluid/rig.hpp"
#include "shape/mass.hpp"
#include "shape/shape.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace bodies_test {

using reference::vec;
glm::dquat quat(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

Solid body(Solid solid, double density, glm::dvec3 velocity = glm::dvec3(0)) {
  solid.friction = 0.4;
  solid.body = Body{.density = density, .velocity = {velocity.x, velocity.y, velocity.z}};
  return solid;
}

Solid turned(Solid solid, glm::dvec3 axis, double angle) {
  const glm::dquat q = glm::angleAxis(angle, glm::normalize(axis));
  solid.rotation = {q.x, q.y, q.z, q.w};
  return solid;
}

Solid crate(glm::dvec3 center, double edge, double density = 500) {
  return body(slab(center - glm::dvec3(edge / 2), center + glm::dvec3(edge / 2)), density);
}

/// A ball whose origin is off its center.
Solid eccentricBall(glm::dvec3 center, double radius) {
  MeshData data = ballMesh(radius, 3);
  const Double3 off = {0.3, -0.1, 0.05};
  for (Double3& vertex : data.vertices)
    for (size_t a = 0; a < 3; ++a) vertex[a] += off[a];
  return {.shape = MeshShape{.mesh = meshOf(data)}, .translation = {center.x - off.x, center.y - off.y, center.z - off.z}};
}

/// Fluid under gravity around a light box that is turned, a heavy ball and a mesh, none of which touches another.
Trial crowded() {
  Trial t = trial();
  setWalls(t, {1.2, 1.2, 0.8});
  t.scene.solids = {turned(body(slab({0.15, 0.2, 0.2}, {0.4, 0.35, 0.5}), 300), {0, 0, 1}, 0.4), body(ball({0.7, 0.3, 0.4}, 0.12), 3000),
                    body(eccentricBall({1.0, 0.5, 0.4}, 0.12), 800)};
  addOutsideSolids(t, block({19, 10, 12}, t.d(), {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {1, -1.5, 0.75});
  return t;
}

/// Without fluid: bodies that fall on a slab, on the floor and on each other.
Trial dry() {
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

TEST_F(BodiesTest, MatchReferenceInFluid) {
  expectReferenceMotion(crowded(), 3, 1e-4);
  expectReferenceMotion(crowded(), 10, 2e-3);
}

TEST_F(BodiesTest, FluidAroundThemMatchesReference) { expectEqual(crowded(), 5, 2e-3, 2e-3, 0.01); }

TEST_F(BodiesTest, MatchReferenceWithSeveralIterations) {
  Trial t = crowded();
  t.scene.solver.iterations = 3;
  expectReferenceMotion(t, 5, 1e-3);
}

TEST_F(BodiesTest, InitialPressureMatchesReference) {
  Trial t = crowded();
  t.v.clear();
  t.settle = true;
  expectReferenceMotion(t, 5, 2e-3);
}

TEST_F(BodiesTest, ContactsMatchReference) {
  Trial t = dry();
  t.scene.solids[1].friction = 0.2;
  t.scene.solids[3].friction = 0.9;
  t.scene.solids[4].restitution = 0.4;
  t.scene.solids.push_back(body(eccentricBall({0.4, 1.3, 0.6}, 0.15), 900));
  t.step = 2e-3;
  expectReferenceMotion(t, 60, 1e-3);
  expectReferenceMotion(t, 200, 2e-2);
}

constexpr glm::dvec3 kWind = {8, -6, 5};

/// A blob of fluid far from walls, without gravity, and a box that flies into it.
Trial collision() {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.solids = {turned(body(slab({-0.2, -0.75, -0.2}, {0.2, -0.45, 0.2}), 700, kWind + glm::dvec3(0.5, 3, 0.2)), {1, 0, 2}, 0.3)};
  addOutsideSolids(t, block({12, 12, 12}, t.d(), glm::dvec3(-0.375), 0.02));
  t.v.assign(t.x.size(), kWind);  // so fast that no gain is bounded, which acts on each particle alone
  return t;
}

TEST_F(BodiesTest, ConserveMomentumWithFluid) {
  for (int iterations : {1, 3}) {
    SCOPED_TRACE(iterations);
    Trial t = collision();
    t.scene.solver.iterations = static_cast<uint32_t>(iterations);
    const MassProperties m = massOf(t.scene.solids[0]);
    const double particle = Oracle(t).solver().mass();
    auto run = start(t);
    const auto momenta = [&] {
      const glm::dvec3 fluid = particle * run->snapshot().velocitySum();
      return std::array{fluid, m.mass * vec(motion(*run, 0).velocity)};
    };
    const auto [fluid, solid] = momenta();
    run->substeps(60);
    const auto [fluidAfter, solidAfter] = momenta();
    EXPECT_GT(glm::length(fluidAfter - fluid), 0.1 * m.mass * 3);
    EXPECT_LT(glm::length((fluidAfter - fluid) + (solidAfter - solid)), (iterations == 1 ? 2.5e-4 : 5e-4) * glm::length(solidAfter - solid))
        << "rounding: 4e-5 to 2e-4, by driver";
  }
}

TEST_F(BodiesTest, ConserveMomentumInContacts) {
  Trial t = trial();
  t.capacity = 1;
  t.scene.gravity[1] = 0;
  t.scene.solids = {body(ball({0, 0, 0}, 0.2), 1000, {2, 0.5, 0}), turned(crate({0.5, 0.1, 0}, 0.4, 300), {1, 1, 0}, 0.4),
                    turned(crate({1.0, 0, 0.1}, 0.3, 6000), {0, 1, 0}, 0.3)};
  glm::dvec3 before(0), after(0);
  auto run = start(t);
  for (size_t n = 0; n < 3; ++n) before += massOf(t.scene.solids[n]).mass * vec(motion(*run, n).velocity);
  runFor(*run, 0.3);
  for (size_t n = 0; n < 3; ++n) after += massOf(t.scene.solids[n]).mass * vec(motion(*run, n).velocity);
  EXPECT_GT(glm::length(vec(motion(*run, 2).velocity)), 0.01) << "they did not meet";
  EXPECT_LT(glm::length(after - before), 1e-5 * glm::length(before));
}

// The middle axis of a box is unstable, so that it tumbles.
TEST_F(BodiesTest, TumbleWithConstantAngularMomentum) {
  Trial t = trial();
  t.capacity = 1;
  t.scene.gravity[1] = 0;
  t.scene.solids = {body(slab({-0.1, -0.2, -0.4}, {0.1, 0.2, 0.4}), 500)};
  t.scene.solids[0].body->angular_velocity = {0.01, 5, 0.01};
  const MassProperties m = massOf(t.scene.solids[0]);
  const glm::dvec3 inertia(m.inertia[0], m.inertia[1], m.inertia[2]);
  const auto momentum = [&](const BodyMotion& b) {
    const glm::dquat q = quat(b.rotation);
    return q * (inertia * (glm::inverse(q) * vec(b.angularVelocity)));
  };
  auto run = start(t);
  const glm::dvec3 before = momentum(motion(*run, 0));
  double most = 0;
  for (int n = 0; n < 20; ++n) {
    run->substeps(100);
    run->read({});
    const BodyMotion b = motion(*run, 0);
    EXPECT_LT(glm::length(momentum(b) - before), 0.01 * glm::length(before));
    const glm::dvec3 local = glm::inverse(quat(b.rotation)) * vec(b.angularVelocity);
    most = std::max(most, std::abs(local.z) + std::abs(local.x));
    EXPECT_NEAR(glm::dot(inertia * local, local), 25 * inertia.y, 0.02 * 25 * inertia.y) << "twice the energy";
  }
  EXPECT_GT(most, 2) << "it did not tumble";
}

TEST_F(BodiesTest, FallFreely) {
  Trial t = trial();
  t.capacity = 1;
  t.scene.solids = {body(ball({0, 0, 0}, 0.2), 1000, {1, 2, 0})};
  auto run = start(t);
  runFor(*run, 0.5);
  EXPECT_NEAR(motion(*run, 0).velocity.y, 2 - 9.81 * 0.5, 1e-3);
  EXPECT_NEAR(motion(*run, 0).center.x, 0.5, 1e-3);
  EXPECT_NEAR(motion(*run, 0).center.y, 1 - 9.81 * 0.125, 5e-3);
}

TEST_F(BodiesTest, AreHeldUntilTheirTimeAndAlongLockedDegrees) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solids = {body(slab({0.2, 0.3, 0.2}, {0.4, 0.5, 0.4}), 200), body(slab({0.6, 0.3, 0.6}, {0.8, 0.5, 0.8}), 200)};
  t.scene.solids[0].body->from = 0.0205;
  t.scene.solids[0].body->velocity = {0, 0.1, 0};
  t.scene.solids[1].body->locked = 0b111010;  // free to move along x and z
  addOutsideSolids(t, block({16, 8, 16}, t.d(), {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {1, 0.5, -0.4});
  auto run = start(t);
  run->substeps(20);
  run->read({});
  EXPECT_EQ(motion(*run, 0).center, (Double3{0.3f, 0.4f, 0.3f}));
  EXPECT_EQ(motion(*run, 0).velocity, (Double3{0, 0, 0}));
  EXPECT_GT(glm::length(vec(run->fluid().solidLoads()[0].force)), 0);
  EXPECT_EQ(motion(*run, 1).center.y, 0.4f);
  EXPECT_EQ(motion(*run, 1).rotation, (Quaternion{0, 0, 0, 1}));
  EXPECT_GT(std::abs(motion(*run, 1).velocity.x), 0.01);
  run->substeps(20);
  run->read({});
  EXPECT_GT(motion(*run, 0).velocity.y, 0.05);
}

TEST_F(BodiesTest, FrictionHoldsThemOnSlopesUpToItsAngle) {
  const double friction = 0.4;
  for (const double angle : {0.9 * std::atan(friction), 1.2 * std::atan(friction)}) {
    SCOPED_TRACE(angle);
    Trial t = trial();
    t.capacity = 1;
    Solid ramp = turned(slab({-3, -0.2, -0.5}, {3, 0, 0.5}), {0, 0, 1}, angle);
    const glm::dvec3 normal = quat(ramp.rotation) * glm::dvec3(0, 1, 0), middle(0, -0.1, 0);
    ramp.friction = friction;
    Solid box = turned(crate(middle + (0.1 + 0.1) * normal, 0.2), {0, 0, 1}, angle);
    t.scene.solids = {ramp, box};
    t.step = 2e-3;
    auto run = start(t);
    runFor(*run, 1);
    const double down = glm::length(vec(motion(*run, 1).center) - vec(centerOf(box)));
    const double slides = std::max(0.0, 0.5 * 9.81 * (std::sin(angle) - friction * std::cos(angle)));
    EXPECT_NEAR(down, slides, 0.05 * slides + 2e-3);
  }
}

TEST_F(BodiesTest, BounceByRestitution) {
  Trial t = trial();
  t.capacity = 1;
  setWalls(t, {2, 4, 2});
  Solid sphere = body(ball({1, 1.2, 1}, 0.2), 500);
  sphere.restitution = 0.5;
  t.scene.solids = {sphere};
  auto run = start(t);
  runFor(*run, std::sqrt(2 / 9.81) + 0.05);
  EXPECT_NEAR(motion(*run, 0).velocity.y, 0.5 * std::sqrt(2 * 9.81) - 0.05 * 9.81, 0.05);
}

/// Six crates, three, two and one, with gaps between neighbors.
Trial pyramid() {
  Trial t = trial();
  t.capacity = 1;
  setWalls(t, {2, 2, 1});
  for (int level = 0; level < 3; ++level)
    for (int k = 0; k < 3 - level; ++k) t.scene.solids.push_back(crate({0.5 + 0.31 * k + 0.155 * level, 0.15 + 0.3 * level, 0.5}, 0.3));
  t.step = 2e-3;
  return t;
}

TEST_F(BodiesTest, PyramidsStand) {
  const Trial t = pyramid();
  auto run = start(t);
  runFor(*run, 2);
  for (size_t n = 0; n < t.scene.solids.size(); ++n) {
    EXPECT_LT(glm::length(vec(motion(*run, n).center) - vec(centerOf(t.scene.solids[n]))), 0.01) << n;
    EXPECT_LT(glm::length(vec(motion(*run, n).velocity)), 1e-3) << n;
  }
}

TEST_F(BodiesTest, GoOnFromASnapshotBitForBit) {
  Trial released = crowded();
  for (Solid& solid : released.scene.solids) solid.body->from = 0.05;
  for (const Trial& t : {crowded(), dry(), pyramid(), released}) {
    auto run = start(t);
    run->substeps(100);
    const FluidSnapshot middle = run->saved();
    run->substeps(20);
    auto other = start(t, &middle);
    other->substeps(20);
    const FluidSnapshot one = run->saved(), two = other->saved();
    EXPECT_EQ(one.position, two.position);
    EXPECT_EQ(one.bodies, two.bodies);
    EXPECT_EQ(one.slips, two.slips);
  }
}

TEST_F(BodiesTest, RejectSnapshotsThatAreNotFinite) {
  const Trial t = pyramid();
  auto run = start(t);
  run->substeps(20);
  const FluidSnapshot good = run->saved();
  for (const uint32_t word : {0x7fc00000U, 0x7f800000U, 0x7f000000U}) {
    FluidSnapshot bodies = good, slips = good;
    bodies.bodies[1] = word;
    EXPECT_THROW(start(t, &bodies), std::runtime_error);
    slips.slips[2] = word;
    if (std::isfinite(std::bit_cast<float>(word))) continue;
    EXPECT_THROW(start(t, &slips), std::runtime_error);
  }
  FluidSnapshot named = good;
  named.slips[0] = 0xffffffffU;  // names no solid
  auto other = start(t, &named);
  other->substeps(10);
  EXPECT_TRUE(std::isfinite(motion(*other, 0).center.y));
}

TEST_F(BodiesTest, CountMoreSolidsThanOneTouches) {
  Trial t = trial();
  t.capacity = 1;
  t.scene.solids = {crate({0, 0, 0}, 1)};
  for (int k = 0; k < 40; ++k) t.scene.solids.push_back(ball({0.02 * k - 0.4, 0.52, 0}, 0.05));
  auto run = start(t);
  run->substeps(1);
  EXPECT_EQ(run->stats().loopBoundHits, 40u - kMaxTouched);
}

/// Springs on all bodies that act on points off their centers, one of them as hard as it may.
std::vector<BodyPull> pullsOnAll(const Trial& t) {
  std::vector<BodyPull> pulls;
  for (uint32_t n = 0; n < t.scene.solids.size(); ++n)
    if (t.scene.solids[n].body)
      pulls.push_back({.solid = n, .point = {0.05, -0.04, 0.03}, .target = {0.6, 0.9, 0.45}, .frequency_Hz = 1.5, .dampingRatio = 0.4});
  pulls[0].maxForce = 10;
  pulls.push_back({.solid = pulls[0].solid, .point = {-0.05, 0.02, 0}, .target = {0.2, 0.5, 0.5}, .frequency_Hz = 4});
  return pulls;
}

TEST_F(BodiesTest, PullsMatchReference) {
  for (Trial t : {crowded(), dry()}) {
    t.pulls = pullsOnAll(t);
    t.scene.solids[1].body->locked = 0b010010;  // along y, about y
    const bool inFluid = !t.x.empty();
    expectReferenceMotion(t, inFluid ? 4 : 25, inFluid ? 1e-3 : 2e-3);
  }
}

/// A ball in free fall without fluid, on a spring.
Trial pulled(double frequency, double dampingRatio) {
  Trial t = trial();
  t.capacity = 1;
  t.step = 2e-3;
  t.scene.gravity[1] = 0;
  t.scene.solids = {body(ball({0, 0, 0}, 0.1), 500)};
  t.pulls = {{.solid = 0, .target = {0.3, 0.2, -0.1}, .frequency_Hz = frequency, .dampingRatio = dampingRatio}};
  return t;
}

TEST_F(BodiesTest, PulledOnesFollowTheDampedOscillator) {
  const double rate = 2 * std::numbers::pi;
  const glm::dvec3 target(0.3, 0.2, -0.1);
  auto critical = start(pulled(1, 1)), light = start(pulled(1, 0.1));
  for (const double t : {0.15, 0.3}) {  // implicit steps damp a little more
    runFor(*critical, 0.15);
    runFor(*light, 0.15);
    EXPECT_LT(glm::length(vec(motion(*critical, 0).center) - (1 - (1 + rate * t) * std::exp(-rate * t)) * target),
              0.02 * glm::length(target));
    const double damped = std::sqrt(0.99) * rate;
    const double left = std::exp(-0.1 * rate * t) * (std::cos(damped * t) + 0.1 * rate / damped * std::sin(damped * t));
    EXPECT_LT(glm::length(vec(motion(*light, 0).center) - (1 - left) * target), 0.04 * glm::length(target));
  }
}

TEST_F(BodiesTest, CriticallyDampedPullsSettleWithoutOvershoot) {
  for (const double frequency : {4.0, 1e6}) {  // the last is stiff at any step
    SCOPED_TRACE(frequency);
    Trial t = pulled(frequency, 1);
    t.step = 5e-3;
    const glm::dvec3 target = vec(t.pulls[0].target);
    auto run = start(t);
    for (int n = 0; n < 6; ++n) {
      runFor(*run, 0.1);
      EXPECT_LT(glm::dot(vec(motion(*run, 0).center), target), (1 + 1e-5) * glm::dot(target, target)) << n;
    }
    EXPECT_LT(glm::length(vec(motion(*run, 0).center) - target), 1e-4);
    run->pulls.clear();
    runFor(*run, 0.05);
    EXPECT_LT(glm::length(vec(motion(*run, 0).center) - target), 1e-3) << "released";
  }
}

TEST_F(BodiesTest, PullsKeepToTheirForceAndLockedDegrees) {
  Trial t = pulled(1000, 1);
  t.scene.solids.push_back(body(slab({1, 0, 0}, {1.2, 0.2, 0.2}), 500));
  t.scene.solids[1].body->locked = 0b111110;  // free along x
  t.scene.solids.push_back(body(ball({3, 0, 0}, 0.1), 500));
  t.scene.solids[2].body->from = 10;
  t.pulls[0].maxForce = 3;
  t.pulls.push_back({.solid = 1, .point = {0.1, 0.1, 0.1}, .target = {1.5, 4, 7}, .frequency_Hz = 5});
  t.pulls.push_back({.solid = 2, .target = {5, 5, 5}});
  auto run = start(t);
  runFor(*run, 0.2);
  const double mass = massOf(t.scene.solids[0]).mass;
  EXPECT_NEAR(glm::length(vec(motion(*run, 0).velocity)), 0.2 * 3 / mass, 1e-3 * 0.2 * 3 / mass);
  runFor(*run, 0.3);
  EXPECT_NEAR(motion(*run, 1).center.x, 1.4, 1e-3) << "its point is at the target along x";
  EXPECT_EQ(motion(*run, 1).center.y, 0.1f);
  EXPECT_EQ(motion(*run, 1).rotation, (Quaternion{0, 0, 0, 1}));
  EXPECT_EQ(motion(*run, 2).center, (Double3{3, 0, 0}));
}

// Bits do not depend on pieces, and pulls are no part of a snapshot.
TEST_F(BodiesTest, PullsGoOnFromASnapshotBitForBit) {
  Trial t = crowded();
  t.pulls = pullsOnAll(t);
  auto run = start(t), pieces = start(t);
  run->substeps(40);
  pieces->substeps(40, 4);
  const FluidSnapshot middle = run->saved();
  EXPECT_EQ(middle.bodies, pieces->saved().bodies);
  auto other = start(t, &middle);
  for (Run* each : {run.get(), other.get()}) each->substeps(20);
  EXPECT_EQ(run->saved(), other->saved());
  for (Run* each : {run.get(), other.get()}) {
    each->pulls.clear();
    each->substeps(20);
  }
  EXPECT_EQ(run->saved(), other->saved());
  Trial free = t;
  free.pulls.clear();
  auto released = start(free, &middle), kept = start(t, &middle);
  released->substeps(20);
  kept->substeps(20);
  EXPECT_NE(released->saved().bodies, kept->saved().bodies);
}

TEST_F(BodiesTest, RejectInvalidPulls) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Trial t = pulled(1, 1);
  t.scene.solids.push_back(ball({2, 0, 0}, 0.1));
  auto run = start(t);
  const auto message = [&](std::vector<BodyPull> pulls, bool queued = false) {
    Graph graph;
    (void)run->fluid().addTo(graph, {.advance_s = 0.01, .pulls = pulls, .queued = queued});
    const auto compiled = graph.compile();
    return compiled ? std::string("compiled") : compiled.error().message;
  };
  EXPECT_EQ(message({{.solid = 0}, {.solid = 2}}), "FluidStep::pulls[1].solid is 2; the scene has 2 solids");
  EXPECT_EQ(message({{.solid = 1}}), "FluidStep::pulls[0].solid is 1, which is not a body; expected the index of a solid with a body");
  EXPECT_EQ(message({{.point = {0, nan, 0}}}), "FluidStep::pulls[0].point is [0, nan, 0]; expected finite numbers (m)");
  EXPECT_EQ(message({{.target = {0, 0, BodyPull::kNoBound}}}), "FluidStep::pulls[0].target is [0, 0, inf]; expected finite numbers (m)");
  EXPECT_EQ(message({{.frequency_Hz = 0}}), "FluidStep::pulls[0].frequency_Hz is 0; expected a number above 0, at most 1e6 (Hz)");
  EXPECT_EQ(message({{.dampingRatio = -1}}), "FluidStep::pulls[0].dampingRatio is -1; expected a number from 0 to 1e6");
  EXPECT_EQ(message({{.maxForce = nan}}), "FluidStep::pulls[0].maxForce is nan; expected a number above 0 (N)");
  EXPECT_EQ(message(std::vector<BodyPull>(65)), "FluidStep::pulls has 65 entries; expected at most 64");
  EXPECT_EQ(message({{}}, true), "FluidStep::queued is set; expected false where bodies are pulled");
  run->pulls = {{.target = {1e300, -1e300, 0}, .frequency_Hz = 1e6, .dampingRatio = 1e6, .maxForce = 1e300}};
  run->substeps(5);
  run->read({});
  EXPECT_TRUE(std::isfinite(motion(*run, 0).center.x));
}

/// Finite, within the walls, and no faster than what was there.
void expectSane(const BodyMotion& m, double fastest, const glm::dvec3& size, double radius) {
  for (size_t a = 0; a < 3; ++a) {
    EXPECT_TRUE(std::isfinite(m.center[a]) && std::isfinite(m.velocity[a]) && std::isfinite(m.angularVelocity[a]));
    EXPECT_GT(m.center[a], -radius);
    EXPECT_LT(m.center[a], size[static_cast<int>(a)] + radius);
  }
  EXPECT_LT(glm::length(vec(m.velocity)), fastest);
}

TEST_F(BodiesTest, HandleDegenerateInput) {
  const glm::dvec3 size(1, 1, 1);
  struct Case {
    const char* name;
    std::vector<Solid> solids;
    double fastest;
  };
  Solid locked = crate({0.5, 0.5, 0.5}, 0.3);
  locked.body->locked = 0b111111;
  Solid spinning = crate({0.5, 0.5, 0.5}, 0.3);
  spinning.body->angular_velocity = {1000, 0, 0};
  const std::vector<Case> cases = {
      {"one within another", {crate({0.5, 0.3, 0.5}, 0.3), crate({0.5, 0.3, 0.5}, 0.3), body(ball({0.5, 0.3, 0.5}, 0.1), 100)}, 10},
      {"in a wall", {crate({0, 0, 0.5}, 0.3), body(ball({1, 0.5, 1}, 0.2), 100)}, 10},
      {"larger than the domain", {crate({0.5, 0.5, 0.5}, 3)}, 10},
      {"mass ratios", {crate({0.5, 0.15, 0.5}, 0.3, 1), crate({0.5, 0.46, 0.5}, 0.3, 1e6)}, 20},
      {"fast", {body(ball({0.2, 0.5, 0.5}, 0.1), 500, {100, 0, 0}), crate({0.6, 0.5, 0.5}, 0.2)}, 110},
      {"locked", {locked, crate({0.5, 0.7, 0.5}, 0.2)}, 10},
      {"spinning", {spinning}, 200},
      {"tiny", {crate({0.5, 0.5, 0.5}, 1e-3), body(ball({0.5, 0.5, 0.5}, 1e-4), 1)}, 100},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    Trial t = trial();
    setWalls(t, size);
    t.scene.solids = c.solids;
    addOutsideSolids(t, block({16, 6, 16}, t.d(), {0, 0, 0}, 0.02));
    if (t.x.empty()) t.capacity = 1;
    auto run = start(t);
    run->substeps(200);
    EXPECT_TRUE(run->snapshot().finite());
    for (size_t n = 0; n < c.solids.size(); ++n) expectSane(motion(*run, n), c.fastest, size, boundingRadius(c.solids[n].shape));
  }
}

}  // namespace bodies_test
}  // namespace rill::test
