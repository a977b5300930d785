// Viscous fluid that sticks to walls, solids and bodies: against the reference, and against the flow between two plates.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "fluid/force_loads_fixture.hpp"
#include "shape/mass.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace no_slip_test {

using reference::vec;

/// A block with noise, at walls on all sides.
Trial noisy(double viscosity) {
  Trial t = trial();
  t.scene.fluid.viscosity = viscosity;
  setWalls(t, {0.6, 0.7, 0.5});
  t.scene.domain->slip = false;
  t.x = block({9, 8, 8}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
  return t;
}

/// Fluid between walls around a box that is turned, a ball that moves and turns, and a mesh; it slips along the walls and the box.
Trial crowded(double viscosity) {
  Trial t = trial();
  t.scene.fluid.viscosity = viscosity;
  setWalls(t, {1.1, 1.2, 0.7});
  Solid box = slab({0.05, 0.1, 0.1}, {0.35, 0.3, 0.4}), moving = ball({0.65, 0.3, 0.4}, 0.12);
  box.rotation = {0, 0, std::sin(0.2), std::cos(0.2)};
  moving.motion = {{0, {0, 0, 0}}, {0.1, {0.1, 0.05, 0}, {0, std::sin(0.2), 0, std::cos(0.2)}}};
  Solid mesh{.shape = MeshShape{.mesh = meshOf(ballMesh(0.12, 3))}, .translation = {0.9, 0.2, 0.15}};
  t.scene.solids = {box, moving, mesh};
  for (Solid& solid : t.scene.solids) solid.slip = false;
  t.loads = true;
  addOutsideSolids(t, block({17, 10, 11}, t.d(), {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {1, -1.5, 0.75});
  return t;
}

Solid body(Solid solid, double density) {
  solid.body = Body{.density = density};
  solid.slip = false;
  return solid;
}

/// Bodies in a stream far from walls, without gravity: one much lighter than the fluid that sticks to it, one that is held along an axis
/// and about another, two so near each other that particles stick to both.
Trial stream() {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.fluid.viscosity = 400;
  Solid box = body(slab({-0.2, -0.3, -0.25}, {0.2, -0.1, 0.2}), 40);
  box.rotation = {0, 0, std::sin(0.2), std::cos(0.2)};
  Solid locked = body(ball({0.15, 0.25, 0.1}, 0.12), 2000);
  locked.body->locked = 0b100001;
  t.scene.solids = {box, locked, body(ball({-0.14, 0.25, 0.1}, 0.1), 500)};
  addOutsideSolids(t, block({12, 14, 12}, 0.985 * t.d(), glm::dvec3(-0.4), 0.02));
  for (const glm::dvec3& x : t.x) t.v.push_back(glm::dvec3(8, -6, 5) + 2.0 * glm::cross(glm::dvec3(1, 2, 3), x));
  return t;
}

using NoSlipTest = ForceLoadsTest;

TEST_F(NoSlipTest, WallsMatchReference) {
  expectEqual(noisy(20), 1, 1e-4, 1e-4);
  expectEqual(noisy(20), 10, 4e-3, 4e-3, 0.01);
  expectEqual(noisy(2500), 3, 1e-3, 1e-3);
}

TEST_F(NoSlipTest, SolidsMatchReference) {
  expectEqual(crowded(20), 3, 2e-3, 2e-3);
  Trial t = crowded(2500);  // several steps
  t.scene.domain->slip = false;
  t.scene.solids[0].slip = true;
  expectEqual(t, 3, 2e-3, 2e-3);
}

TEST_F(NoSlipTest, LoadsMatchReference) { expectReferenceMotion(crowded(200), 3, 5e-3); }

TEST_F(NoSlipTest, BodiesMatchReference) {
  Trial t = stream();
  expectReferenceMotion(t, 5, 5e-3);
  t.scene.fluid.viscosity = 3000;  // several steps
  expectReferenceMotion(t, 3, 5e-3);
}

TEST_F(NoSlipTest, ConservesMomentumWithBodies) {
  Trial t = stream();
  t.scene.solids[1].body->locked = 0;
  const double particle = Oracle(t).solver().mass();
  auto run = start(t);
  const auto momentum = [&](bool ofBodies) {
    glm::dvec3 sum = particle * run->snapshot().velocitySum();
    if (ofBodies)
      for (const BodyMotion& m : run->fluid().bodies()) sum += massOf(t.scene.solids[m.solid]).mass * vec(m.velocity);
    return sum;
  };
  const glm::dvec3 before = momentum(true), fluid = momentum(false);
  run->substeps(30);
  EXPECT_GT(glm::length(momentum(false) - fluid), 10) << "N s";
  EXPECT_LT(glm::length(momentum(true) - before), 1e-3 * glm::length(momentum(false) - fluid));
}

// A body with a hundredth of the fluid's density gets the fluid's velocity, and does not overshoot it.
TEST_F(NoSlipTest, LightBodyIsCarriedAlong) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.fluid.viscosity = 3000;
  t.scene.solids = {body(ball({0, 0, 0}, 0.15), 10)};
  addOutsideSolids(t, block({12, 12, 12}, t.d(), glm::dvec3(-0.375)));
  t.v.assign(t.x.size(), {3, 0, 0});
  auto run = start(t);
  for (int n = 0; n < 20; ++n) {
    run->substeps(1);
    EXPECT_LT(run->fluid().bodies()[0].velocity.x, 3.001) << n;
  }
  EXPECT_GT(run->fluid().bodies()[0].velocity.x, 2.9);
}

constexpr double kSpeed = 0.02, kGap = 0.5, kWidth = 0.25, kLong = 1.5;  // m/s, m

/// Fluid between a floor at rest and a lid that moves, both solids.
Trial plates(double speed = kSpeed, double length = kLong) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.fluid.viscosity = 500;
  setWalls(t, {length, kGap, kWidth}, 0b001111);
  constexpr double kThick = 0.3;
  t.scene.solids = {slab({0, -kThick, -kThick}, {length, 0, kWidth + kThick}),
                    slab({0, kGap, -kThick}, {length, kGap + kThick, kWidth + kThick})};
  for (Solid& solid : t.scene.solids) solid.slip = false;
  t.scene.solids[1].motion = {{0, {0, 0, 0}}, {10, {10 * speed, 0, 0}}};
  t.loads = true;
  t.x = block({static_cast<int>(length / t.d()), 8, 4}, t.d());
  return t;
}

// The fluid's free ends bear no shear: the load is judged by what plates of twice the length add.
TEST_F(NoSlipTest, ShearsFluidBetweenPlates) {
  glm::dvec2 loads(0);
  double shear = 0;
  for (const double length : {kLong, 2 * kLong}) {
    const Trial t = plates(kSpeed, length);
    auto run = start(t);
    for (int n = 0; n < 5; ++n) run->substeps(60);
    const Snapshot s = run->snapshot();
    for (size_t i = 0; i < s.x.size(); ++i) {
      if (std::abs(s.x[i].x - length / 2) > kGap / 2) continue;
      EXPECT_NEAR(s.v[i].x, kSpeed * s.x[i].y / kGap, 0.02 * kSpeed) << i;
      EXPECT_LT(std::hypot(s.v[i].y, s.v[i].z), 0.02 * kSpeed) << i;
    }
    for (int k = 0; k < 2; ++k) loads[k] = run->fluid().solidLoads()[k].force.x - loads[k];
    shear = t.scene.fluid.viscosity * kSpeed / kGap * kLong * kWidth;
  }
  EXPECT_NEAR(loads[0], shear, 0.05 * shear);
  EXPECT_NEAR(loads[1], -shear, 0.05 * shear);
}

TEST_F(NoSlipTest, LoadsOfPlatesEqualTheChangeOfMomentum) {
  const Trial t = plates(20 * kSpeed);  // so fast that the rounding of positions does not show
  auto run = start(t);
  const glm::dvec3 before = run->snapshot().velocitySum();
  run->substeps(40);
  const glm::dvec3 change = Oracle(t).solver().mass() * (run->snapshot().velocitySum() - before);
  glm::dvec3 reaction(0);
  for (const SolidLoad& load : run->fluid().solidLoads()) reaction += vec(load.impulse);
  EXPECT_GT(change.x, 0.1) << "N s";
  // After the sudden start the solve of viscosity leaves a part of its residual, which no load has.
  EXPECT_NEAR(change.x + reaction.x, 0, 0.06 * change.x);
}

// With the walls of the domain in place of the floor the flow is the same.
TEST_F(NoSlipTest, WallsHoldFluidAsSolidsDo) {
  Trial t = plates();
  auto solid = start(t);
  t.scene.solids.erase(t.scene.solids.begin());
  t.scene.domain->open = 0b111011;
  t.scene.domain->slip = false;
  auto wall = start(t);
  for (int n = 0; n < 3; ++n) solid->substeps(60), wall->substeps(60);
  const Snapshot a = solid->snapshot(), b = wall->snapshot();
  for (size_t i = 0; i < a.x.size(); ++i)
    if (std::abs(a.x[i].x - kLong / 2) < kGap / 2) { EXPECT_NEAR(a.v[i].x, b.v[i].x, 0.02 * kSpeed) << i; }
}

TEST_F(NoSlipTest, WithoutViscosityHasNoEffect) {
  Trial t = noisy(0), slipping = t;
  slipping.scene.domain->slip = true;
  auto run = start(t), other = start(slipping);
  run->substeps(10);
  other->substeps(10);
  EXPECT_EQ(run->snapshot(), other->snapshot());
  const std::span<const std::string> warnings = run->fluid().warnings();
  EXPECT_EQ(std::ranges::count(warnings, "domain.slip: false has no effect: fluid.viscosity is 0, expected more (Pa s)"), 1);
  EXPECT_EQ(other->fluid().warnings().size() + 1, warnings.size());
}

TEST_F(NoSlipTest, HandlesDegenerateInput) {
  Trial t = stream();
  t.scene.solids.push_back(body(ball({0.15, 0.25, 0.1}, 1e-4), 1));  // inside another, lighter than a particle
  const glm::dvec3 between(0.02, 0.25, 0.1);                         // the two balls
  std::ranges::sort(t.x, {}, [&](const glm::dvec3& x) { return glm::distance(x, between); });
  t.x.resize(40);
  t.v.assign(40, {8, -6, 5});
  t.x[3] = t.x[4];
  t.x[5] = {0.15, 0.25, 0.1};  // at the center of two balls
  t.v[6] = {1e10, 0, 0};
  auto run = start(t);
  run->substeps(20);
  EXPECT_TRUE(run->snapshot().finite());
  for (const BodyMotion& m : run->fluid().bodies()) {
    EXPECT_TRUE(std::isfinite(glm::length(vec(m.velocity)))) << m.solid;
    if (m.solid == 1 || m.solid == 2) { EXPECT_GT(glm::length(vec(m.angularVelocity)), 1e-3) << "turned by fluid that sticks to it"; }
  }
}

}  // namespace no_slip_test
}  // namespace rill::test
