// Surface tension in the reference: the force is the gradient of an energy, which is sigma times the area.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "reference/cloud.hpp"
#include "reference/solver.hpp"

namespace rill::reference {
namespace {

constexpr double kTensionSpacing = 0.1, kTension = 3, kTensionStep = 1e-3;

ReferenceSettings tense() {
  ReferenceSettings s;
  s.spacing = kTensionSpacing;
  s.smoothingRatio = 2.3;
  s.gravity = glm::dvec3(0);
  s.surfaceTension = kTension;
  return s;
}

/// Points of a lattice, moved by a tenth of a spacing.
std::vector<glm::dvec3> heap() {
  std::vector<glm::dvec3> points = lattice(4, 3, 4, kTensionSpacing);
  for (size_t i = 0; i < points.size(); ++i) points[i] += 0.1 * kTensionSpacing * glm::sin(double(i + 1) * glm::dvec3(7, 11, 13));
  return points;
}

void expectForceIsGradient(ReferenceSettings s) {
  ReferenceSolver solver(s, heap());
  if (!s.fluids.empty())
    for (size_t i = 0; i < solver.size(); ++i) solver.state.fluid[i] = static_cast<uint8_t>(i % s.fluids.size());
  solver.surfaceTension(kTensionStep);
  const std::vector<glm::dvec3> v = solver.state.velocity;
  constexpr double kSmall = 1e-6;
  for (size_t i = 0; i < solver.size(); ++i)
    for (int a = 0; a < 3; ++a) {
      const double x = solver.state.position[i][a];
      solver.state.position[i][a] = x + kSmall;
      const double above = solver.surfaceEnergy();
      solver.state.position[i][a] = x - kSmall;
      const double below = solver.surfaceEnergy();
      solver.state.position[i][a] = x;
      const double force = -(above - below) / (2 * kSmall);
      EXPECT_NEAR(v[i][a] / kTensionStep * solver.mass() / solver.inverseMass(i), force, 1e-5 * kTension * kTensionSpacing) << i;
    }
}

TEST(ReferenceSurfaceTension, ForceIsGradientOfEnergy) { expectForceIsGradient(tense()); }

TEST(ReferenceSurfaceTension, ForceIsGradientOfEnergyAtWallsAndSolids) {
  for (const double cosine : {-0.9, 0.0, 0.6}) {
    ReferenceSettings s = tense();
    s.wettingCosine = cosine;
    s.lo = glm::dvec3(-0.2 * kTensionSpacing);
    s.solids.push_back({.shape = BoxShape{{-1, 0.32, -1}, {1, 0.5, 1}}});
    expectForceIsGradient(s);
  }
}

TEST(ReferenceSurfaceTension, ForceIsGradientOfEnergyOfSeveralFluids) {
  ReferenceSettings s = tense();
  s.fluids = {{.density = 1000, .surfaceTension = 3}, {.density = 400, .surfaceTension = 1}, {.density = 10}};
  expectForceIsGradient(s);
}

TEST(ReferenceSurfaceTension, ForceIsGradientOfEnergyOfInterfaces) {
  ReferenceSettings s = tense();
  s.fluids = {{.density = 1000, .surfaceTension = 3}, {.density = 400, .surfaceTension = 1}};
  s.cover[0][1] = s.cover[1][0] = 0.3;
  expectForceIsGradient(s);
  s.fluids.push_back({.density = 10, .surfaceTension = 2});
  s.cover[1][2] = s.cover[2][1] = 0;
  expectForceIsGradient(s);
}

/// The energy of the surface of a ball inside another fluid, without that of the block around it.
double energyOfInterface(double cover) {
  ReferenceSettings s = tense();
  s.fluids = {{.surfaceTension = kTension}, {.surfaceTension = kTension}};
  ReferenceSolver solver(s, lattice(14, 14, 14, kTensionSpacing));
  for (size_t i = 0; i < solver.size(); ++i)
    solver.state.fluid[i] = glm::length(solver.state.position[i] - glm::dvec3(7 * kTensionSpacing)) < 4 * kTensionSpacing;
  const double surface = solver.surfaceEnergy();
  solver.settings.cover[0][1] = solver.settings.cover[1][0] = cover;
  return solver.surfaceEnergy() - surface;
}

TEST(ReferenceSurfaceTension, EnergyOfAnInterfaceIsThatOfItsArea) {
  const double area = 4 * std::numbers::pi * std::pow(4 * kTensionSpacing, 2), whole = energyOfInterface(0);
  EXPECT_NEAR(whole / (2 * kTension * area), 1.2, 0.2) << "of a lattice, whose surface is rough";
  for (const double share : {0.1, 0.3, 0.6, 0.9}) EXPECT_NEAR(energyOfInterface(interfaceCover(share)) / whole, share, 0.1);
  EXPECT_NEAR(energyOfInterface(interfaceCover(0)) / whole, 0, 1e-3);
}

TEST(ReferenceSurfaceTension, NoForceInsideFluid) {
  ReferenceSolver solver(tense(), lattice(13, 13, 13, kTensionSpacing));
  solver.surfaceTension(kTensionStep);
  size_t inside = 0;
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 cell = solver.state.position[i] / kTensionSpacing, low = glm::min(cell, glm::dvec3(13) - cell);
    if (std::min({low.x, low.y, low.z}) < 4) continue;
    ++inside;
    EXPECT_EQ(glm::length(solver.state.velocity[i]), 0);
  }
  EXPECT_GT(inside, 50u);
}

TEST(ReferenceSurfaceTension, EnergyOfABallIsThatOfItsArea) {
  std::vector<glm::dvec3> ball;
  for (const glm::dvec3& x : lattice(20, 20, 20, kTensionSpacing))
    if (glm::length(x - glm::dvec3(10.07 * kTensionSpacing)) < 8 * kTensionSpacing) ball.push_back(x);
  const ReferenceSolver solver(tense(), ball);
  const double volume = static_cast<double>(ball.size()) * std::pow(kTensionSpacing, 3);
  const double radius = std::cbrt(volume * 3 / (4 * std::numbers::pi));
  const double area = solver.surfaceEnergy() / kTension;
  const double exact = 4 * std::numbers::pi * radius * radius;
  EXPECT_NEAR(area / exact, 1.2, 0.2) << "of a lattice, whose surface is rough";
}

}  // namespace
}  // namespace rill::reference
