// Rigid bodies against the reference, and against what mechanics says.
#include <array>

#include "fluid/bodies_fixture.hpp"

namespace rill::test {
namespace bodies_test {

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
    EXPECT_LT(glm::length(momentum(b) - before), 1e-4 * glm::length(before));
    const glm::dvec3 local = glm::inverse(quat(b.rotation)) * vec(b.angularVelocity);
    most = std::max(most, std::abs(local.z) + std::abs(local.x));
    EXPECT_NEAR(glm::dot(inertia * local, local), 25 * inertia.y, 1e-4 * 25 * inertia.y) << "twice the energy";
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

}  // namespace bodies_test
}  // namespace rill::test
