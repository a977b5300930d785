// Walls and solids: collisions, contact, density contribution.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "reference/cloud.hpp"

namespace rill::reference {
namespace {

constexpr double kSpacing = 0.05, kStep = 1e-3;

Solid plate(double friction, double restitution) {
  Solid solid;
  solid.shape = BoxShape{{-5, -1, -5}, {5, 0, 5}};
  solid.friction = friction;
  solid.restitution = restitution;
  return solid;
}

ReferenceSettings over(const Solid& solid) {
  ReferenceSettings s;
  s.spacing = kSpacing;
  s.solids = {solid};
  return s;
}

TEST(Boundary, KeepsCentersHalfASpacingFromSurfaces) {
  for (const bool tabulated : {false, true}) {
    ReferenceSettings s = tank(kSpacing, kSpacing * glm::dvec3(12, 16, 5));
    s.tabulated = tabulated;
    Solid ball, box;
    ball.shape = SphereShape{{6 * kSpacing, 3 * kSpacing, 2.5 * kSpacing}, 1.4 * kSpacing};
    box.shape = BoxShape{{9 * kSpacing, 0, 1.4 * kSpacing}, {10 * kSpacing, 4 * kSpacing, 3.6 * kSpacing}};
    box.rotation[1] = std::sin(0.3), box.rotation[3] = std::cos(0.3);
    s.solids = {ball, box};
    ReferenceSolver solver(s, lattice(4, 12, 5, kSpacing));
    solver.begin(kStep);
    double deepest = 0;
    for (int step = 0; step < (tabulated ? 500 : 100); ++step) {
      solver.substep(kStep, kStep);
      for (const glm::dvec3& x : solver.state.position) {
        for (const Solid& solid : s.solids)
          deepest = std::max(deepest, kSpacing / 2 - surfaceAt(solid.shape, solidPose(solid, 0), {x.x, x.y, x.z}).distance);
        for (int a = 0; a < 3; ++a) ASSERT_TRUE(x[a] >= kSpacing / 2 && x[a] <= s.hi[a] - kSpacing / 2);
      }
    }
    EXPECT_LT(deepest, 1e-12);
    EXPECT_EQ(solver.inactive(), 0u);
    EXPECT_GT(centerOfMass(solver).x, 2.2 * kSpacing);
  }
}

TEST(Boundary, ThinDomainKeepsParticlesInItsMiddle) {
  ReferenceSettings s = tank(kSpacing, {1, 1, 0.4 * kSpacing});
  ReferenceSolver solver(s, std::vector<glm::dvec3>{{0.5, 0.5, 0.9}});
  solver.begin(kStep);
  for (int step = 0; step < 10; ++step) solver.substep(kStep, kStep);
  EXPECT_NEAR(solver.state.position[0].z, 0.2 * kSpacing, 1e-15);
}

// A surface covers the directions along it, and not the direction of its normal.
TEST(Boundary, SolidCoversDirectionsAlongItsSurface) {
  const auto at = [](const Solid& solid, const glm::dvec3& x) {
    return ReferenceSolver(over(solid), std::vector<glm::dvec3>{x}).boundaryAt(x, 0);
  };
  const SolidSample floor = at(plate(0, 0), {0, kSpacing / 2, 0});
  EXPECT_GT(floor.value, 0.1);
  EXPECT_NEAR(floor.coverage[0], floor.value, 1e-12);
  EXPECT_NEAR(floor.coverage[1], 0, 1e-12);
  EXPECT_NEAR(floor.coverage[2], floor.value, 1e-12);
  Solid turned = plate(0, 0);  // by 45 degrees: the face x + y = 7.07 m covers x and y by one half
  turned.shape = BoxShape{{-5, -5, -5}, {5, 5, 5}};
  turned.rotation[2] = std::sin(std::numbers::pi / 8);
  turned.rotation[3] = std::cos(std::numbers::pi / 8);
  const double out = (5 + kSpacing / 2) / std::numbers::sqrt2;
  const SolidSample slope = at(turned, {out, out, 0});
  EXPECT_NEAR(slope.value, floor.value, 1e-6);
  EXPECT_NEAR(slope.coverage[0], slope.value / 2, 1e-6);
  EXPECT_NEAR(slope.coverage[1], slope.value / 2, 1e-6);
  EXPECT_NEAR(slope.coverage[2], slope.value, 1e-6);
  EXPECT_NEAR(slope.coverageMixed[2], -slope.value / 2, 1e-6);
  EXPECT_NEAR(slope.coverageMixed[0], 0, 1e-12);
  Solid ball;
  ball.shape = SphereShape{{0, 0, 0}, 4 * kSpacing};
  const SolidSample pole = at(ball, {0, 0, 4.5 * kSpacing});
  EXPECT_NEAR(pole.coverage[0], pole.value, 1e-12);
  EXPECT_NEAR(pole.coverage[2], 0, 1e-12);
}

TEST(Boundary, OpenSideLetsParticlesLeave) {
  ReferenceSettings s = tank(kSpacing, {1, 1, 1});
  s.hi.x = std::numeric_limits<double>::infinity();
  s.gravity = glm::dvec3(0);
  ReferenceSolver solver(s, std::vector<glm::dvec3>{{0.9, 0.5, 0.5}}, std::vector<glm::dvec3>{{10, 0, 0}});
  solver.begin(kStep);
  for (int step = 0; step < 100; ++step) solver.substep(kStep, kStep);
  EXPECT_NEAR(solver.state.position[0].x, 1.9, 1e-9);
}

TEST(Contact, BounceMatchesRestitution) {
  for (const double e : {0.0, 0.3, 0.8, 1.0}) {
    ReferenceSolver solver(over(plate(0, e)), std::vector<glm::dvec3>{{0, 0.325, 0}});
    solver.begin(kStep);
    double fastest = 0, rebound = 0;
    for (int step = 0; step < 400; ++step) {
      solver.substep(kStep, kStep);
      fastest = std::min(fastest, solver.state.velocity[0].y);
      rebound = std::max(rebound, solver.state.velocity[0].y);
      EXPECT_GE(solver.state.position[0].y, 0.5 * kSpacing - 1e-12);
    }
    EXPECT_NEAR(-rebound / fastest, e, 0.02);
  }
}

TEST(Contact, FrictionDeceleratesByMuG) {
  const double mu = 0.25;
  ReferenceSolver solver(over(plate(mu, 0)), std::vector<glm::dvec3>{{0, kSpacing / 2, 0}}, std::vector<glm::dvec3>{{2, 0, 0}});
  solver.begin(kStep);
  for (int step = 0; step < 200; ++step) solver.substep(kStep, kStep);
  EXPECT_NEAR(solver.state.velocity[0].x, 2 - mu * 9.81 * 0.2, 0.01);
  for (int step = 0; step < 1000; ++step) solver.substep(kStep, kStep);
  EXPECT_NEAR(solver.state.velocity[0].x, 0, 1e-12);
}

TEST(Contact, FrictionAcceleratesToSpeedOfMovingSolid) {
  Solid belt = plate(0.5, 0);
  belt.motion = {{0, {0, 0, 0}}, {10, {10, 0, 0}}};
  ReferenceSolver solver(over(belt), std::vector<glm::dvec3>{{0, kSpacing / 2, 0}});
  solver.begin(kStep);
  for (int step = 0; step < 1000; ++step) solver.substep(kStep, kStep);
  EXPECT_NEAR(solver.state.velocity[0].x, 1, 1e-9);
  EXPECT_NEAR(solver.time(), 1, 1e-9);
}

// A fast belt under a settled column transfers the momentum mu M g dt per substep: friction includes the weight of the whole column.
TEST(Contact, FrictionIncludesWeightOfColumn) {
  for (const int layers : {1, 3, 8}) {
    const int wide = 6;
    ReferenceSettings s = tank(kSpacing, kSpacing * glm::dvec3(wide, 40, wide));
    s.lo.y = -kSpacing;
    s.viscosity = 5;
    Solid belt = plate(0, 0);
    std::get<BoxShape>(belt.shape).min[0] = -50;
    belt.motion = {{0, {0, 0, 0}}, {10, {100, 0, 0}}};
    s.solids = {belt};
    ReferenceSolver solver(s, lattice(wide, layers, wide, kSpacing));
    solver.begin(kStep);
    double given = 0;
    const int settle = 400, measure = 200;
    for (int step = 0; step < settle + measure; ++step) {
      if (step >= settle) {
        ReferenceSolver withFriction = solver, frictionless = solver;
        withFriction.settings.solids[0].friction = 0.2;
        withFriction.substep(kStep, kStep);
        frictionless.substep(kStep, kStep);
        given += (meanVelocity(withFriction).x - meanVelocity(frictionless).x) / (0.2 * 9.81 * kStep * measure);
      }
      solver.substep(kStep, kStep);
    }
    EXPECT_NEAR(given, 1, 0.05) << layers << " layers";
  }
}

TEST(Boundary, MovingSphereDisplacesParticles) {
  Solid ball;
  ball.shape = SphereShape{{-0.5, 0, 0}, 0.2};
  ball.motion = {{0, {0, 0, 0}}, {1, {1, 0, 0}}};
  ReferenceSettings s = over(ball);
  s.gravity = glm::dvec3(0);
  s.origin = {3, 0, 0};  // positions are relative to it
  ReferenceSolver solver(s, std::vector<glm::dvec3>{{-3, 0.01, 0}});
  solver.begin(kStep);
  for (int step = 0; step < 1000; ++step) {
    solver.substep(kStep, kStep);
    const Pose pose = solidPose(ball, solver.time());
    const Double3 at = {solver.state.position[0].x + 3, solver.state.position[0].y, solver.state.position[0].z};
    EXPECT_GE(surfaceAt(ball.shape, pose, at).distance, kSpacing / 2 - 1e-9);
  }
  EXPECT_GT(glm::length(solver.state.position[0] - glm::dvec3(-3, 0.01, 0)), 0.1);
}

TEST(Boundary, TablesAndLatticeSumsGiveSameFlow) {
  std::vector<glm::dvec3> at[2];
  for (const bool tabulated : {false, true}) {
    ReferenceSettings s = tank(kSpacing, kSpacing * glm::dvec3(10, 10, 4));
    s.tabulated = tabulated;
    Solid ball;
    ball.shape = SphereShape{{7 * kSpacing, 2 * kSpacing, 2 * kSpacing}, kSpacing};
    s.solids = {ball};
    ReferenceSolver solver(s, lattice(4, 6, 4, kSpacing));
    solver.begin(kStep);
    for (int step = 0; step < 40; ++step) solver.substep(kStep, kStep);
    at[tabulated] = solver.state.position;
  }
  for (size_t i = 0; i < at[0].size(); ++i) EXPECT_LT(glm::length(at[0][i] - at[1][i]), 0.02 * kSpacing);
}

}  // namespace
}  // namespace rill::reference
