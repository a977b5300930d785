// Solids that keyframes rotate: what they do to the fluid, on the device and in the reference.
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"
#include "shape/records.hpp"

namespace rill::test {
namespace rotating_solid_test {

constexpr glm::dvec3 kMiddle = {0.5, 0.4, 0.5};

/// Turns at `speed` rad/s about y for a second: four keyframes, since each turns the shorter way.
Solid turning(Solid solid, double speed) {
  for (int k = 0; k <= 4; ++k) {
    const double half = 0.5 * speed * 0.25 * k;
    solid.motion.push_back({0.25 * k, {0, 0, 0}, {0, std::sin(half), 0, std::cos(half)}});
  }
  return solid;
}

/// Fluid at rest around what turns, without gravity.
Trial around(Solid solid) {
  Trial t = trial();
  setWalls(t, {1, 0.5, 1});
  for (double& g : t.scene.gravity) g = 0;
  t.scene.solids = {std::move(solid)};
  for (const glm::dvec3& x : block({14, 6, 14}, t.d(), {0.0625, 0.0625, 0.0625}, 0.05)) {
    const SurfacePoint point = surfaceAt(t.scene.solids[0].shape, solidPose(t.scene.solids[0], 0), {x.x, x.y, x.z});
    if (point.distance > 0.5 * t.d()) t.x.push_back(x);
  }
  return t;
}

Trial paddle(double speed) { return around(turning(slab({0.2, 0.05, 0.45}, {0.8, 0.45, 0.55}), speed)); }

/// About the vertical axis through the middle, over the mass of a particle, m^2/s.
double angularMomentum(const std::vector<glm::dvec3>& x, const std::vector<glm::dvec3>& v) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += glm::cross(x[i] - kMiddle, v[i]).y;
  return sum;
}

class RotatingSolidTest : public FluidTest {
 protected:
  /// The fluid's angular momentum on the device after some substeps, and the reference's.
  std::pair<double, double> momenta(const Trial& t, int substeps) {
    auto run = start(t);
    run->substeps(substeps);
    Oracle oracle(t);
    oracle.advance(substeps);
    const Snapshot s = run->snapshot();
    EXPECT_TRUE(s.finite());
    return {angularMomentum(s.x, s.v), angularMomentum(oracle.solver().state.position, oracle.solver().state.velocity)};
  }
};

TEST_F(RotatingSolidTest, PaddleMatchesReference) {
  const Trial t = paddle(4);
  expectEqual(t, 1, 2e-5, 2e-3);
  expectEqual(t, 10, 2e-4, 2e-2);
}

TEST_F(RotatingSolidTest, PaddleStirsTheFluid) {
  for (const double speed : {4.0, -4.0}) {
    const auto [device, reference] = momenta(paddle(speed), 60);
    EXPECT_GT(device * speed, 0) << speed;
    EXPECT_NEAR(device, reference, 0.02 * std::abs(reference)) << speed;
    EXPECT_GT(std::abs(device), 10) << "m^2/s";
  }
}

// A ball keeps its shape: only friction moves the fluid.
TEST_F(RotatingSolidTest, BallDragsByFriction) {
  Trial t = around(turning(ball(kMiddle - glm::dvec3(0, 0.15, 0), 0.2), 10));
  t.scene.gravity[1] = -9.81;
  const auto [without, referenceWithout] = momenta(t, 40);
  t.scene.solids[0].friction = 0.5;
  const auto [with, referenceWith] = momenta(t, 40);
  EXPECT_GT(with - without, 0.15) << "m^2/s; 0.171 was measured";
  EXPECT_NEAR(with - without, referenceWith - referenceWithout, 0.05 * std::abs(referenceWith));
}

TEST_F(RotatingSolidTest, DevicePoseMatchesKeyframes) {
  const Trial t = paddle(4);
  auto run = start(t);
  run->substeps(130);
  const PoseRecord pose = poseAt(run->saved().solids, 0);
  const Pose wanted = solidPose(t.scene.solids[0], 130 * t.step);
  EXPECT_NEAR(pose.rotationY, wanted.rotation[1], 1e-5);
  EXPECT_NEAR(pose.rotationW, wanted.rotation[3], 1e-5);
  EXPECT_NEAR(pose.angularY, 4, 1e-5);
  EXPECT_NEAR(pose.centerX, 0.5, 1e-6);
}

// The speed that the list's travel and the speed limits follow is that of the farthest corner.
TEST_F(RotatingSolidTest, SpeedBoundIncludesTheFarthestCorner) {
  Trial t = paddle(4);
  const ParticleSet particles = t.particles();
  const auto setup = makeFluidSetup(t.scene, {.capacity = static_cast<uint32_t>(particles.positions.size()), .extent = {1, 0.5, 1}});
  ASSERT_TRUE(setup);
  EXPECT_NEAR(setup->params.solidSpeed, 4 * std::sqrt(0.3 * 0.3 + 0.2 * 0.2 + 0.05 * 0.05), 1e-5);
  t.scene.solids[0].motion = {{0, {0, 0, 0}}, {2, {0, 0, 3}}};
  const auto moving = makeFluidSetup(t.scene, {.capacity = 100, .extent = {1, 0.5, 1}});
  ASSERT_TRUE(moving);
  EXPECT_NEAR(moving->params.solidSpeed, 1.5, 1e-6);
}

}  // namespace rotating_solid_test
}  // namespace rill::test
