// The implicit step of viscosity: decay of a shear wave, conservation, and the steps that approach the exact solution.
#include <gtest/gtest.h>

#include <numbers>

#include "reference/crowded.hpp"
#include "shared/viscosity_steps.h"

namespace rill::reference {
namespace {

/// Damping rate of the shear wave v_x = cos(pi y / L) in a lattice between planes, over that of an implicit step of nu k^2.
double decayOverTheory(double ratio, double viscosity, int steps) {
  const int layers = 24, wide = 9;
  ReferenceSettings s = freeSpace();
  s.smoothingRatio = ratio;
  s.viscosity = viscosity;
  s.viscositySteps = steps;
  ReferenceSolver solver(s, lattice(wide, layers, wide, kStageSpacing));
  const double wave = std::numbers::pi / (layers * kStageSpacing), nu = s.viscosity / s.density, dt = 0.02;
  // Reset the field every step from the middle column, so that the sides of the block, which lack neighbors, have no influence.
  std::vector<double> column(layers);
  for (int j = 0; j < layers; ++j) column[j] = std::cos(wave * (j + 0.5) * kStageSpacing);
  const auto middle = [&](int j) { return static_cast<size_t>((wide / 2 * layers + j) * wide + wide / 2); };
  solver.density();
  const int substeps = 100;
  const auto amplitude = [&] {
    double sum = 0;
    for (int j = 0; j < layers; ++j) sum += column[j] * std::cos(wave * (j + 0.5) * kStageSpacing) * 2 / layers;
    return sum;
  };
  const double start = amplitude();
  for (int step = 0; step < substeps; ++step) {
    for (size_t i = 0; i < solver.size(); ++i) solver.state.velocity[i] = {column[(i / wide) % layers], 0, 0};
    solver.viscosity(dt);
    for (int j = 0; j < layers; ++j) column[j] = solver.state.velocity[middle(j)].x;
  }
  return std::log(start / amplitude()) / (std::log(1 + nu * wave * wave * dt) * substeps);
}

TEST(Viscosity, ShearWaveDecaysAtGivenViscosity) {
  for (const int steps : {0, 1, 4}) {
    EXPECT_NEAR(decayOverTheory(2.3, 2, steps), 1, 0.03) << steps;
    EXPECT_NEAR(decayOverTheory(3, 2, steps), 1, 0.06) << steps;
  }
}

glm::dvec3 angularMomentum(const ReferenceSolver& solver) {
  glm::dvec3 sum(0);
  for (size_t i = 0; i < solver.size(); ++i) sum += glm::cross(solver.state.predicted[i], solver.state.velocity[i]);
  return sum;
}

TEST(Viscosity, ConservesMomentaAndDissipatesEnergy) {
  for (const double viscosity : {1e-3, 50.0, 1e4})
    for (const int steps : {0, 1, 5, 64}) {
      ReferenceSettings s = freeSpace();
      s.viscosity = viscosity;
      s.viscositySteps = steps;
      ReferenceSolver solver = crowded(s);
      solver.density();
      const glm::dvec3 before = meanVelocity(solver), turning = angularMomentum(solver);
      const double kinetic = energy(solver);
      solver.viscosity(kStageStep);
      EXPECT_LT(glm::length(meanVelocity(solver) - before), 1e-12) << viscosity << " " << steps;
      EXPECT_LT(glm::length(angularMomentum(solver) - turning), 1e-9) << viscosity << " " << steps;
      EXPECT_LT(energy(solver), kinetic) << viscosity << " " << steps;
    }
}

TEST(Viscosity, LeavesRigidMotionAlone) {
  ReferenceSettings s = freeSpace();
  s.viscosity = 100;
  ReferenceSolver solver = crowded(s);
  solver.density();
  for (size_t i = 0; i < solver.size(); ++i)
    solver.state.velocity[i] = glm::dvec3(1, 2, 3) + glm::cross(glm::dvec3(4, -5, 6), solver.state.predicted[i]);
  const std::vector<glm::dvec3> before = solver.state.velocity;
  solver.viscosity(kStageStep);
  for (size_t i = 0; i < solver.size(); ++i) EXPECT_LT(glm::length(solver.state.velocity[i] - before[i]), 1e-11) << i;
}

// The steps of the shaders leave at most kViscosityRemaining of the change that the exact solution makes.
TEST(Viscosity, ItsStepsApproachTheExactSolution) {
  for (const double viscosity : {0.1, 10.0, 1000.0}) {
    ReferenceSettings s = freeSpace();
    s.viscosity = viscosity;
    ReferenceSolver exact = crowded(s);
    s.viscositySteps = 64;
    ReferenceSolver stepped = crowded(s);
    const std::vector<glm::dvec3> before = exact.state.velocity;
    double change = 0, error = 0;
    for (ReferenceSolver* solver : {&exact, &stepped}) {
      solver->density();
      solver->viscosity(kStageStep);
    }
    for (size_t i = 0; i < exact.size(); ++i) {
      const glm::dvec3 off = stepped.state.velocity[i] - exact.state.velocity[i], by = exact.state.velocity[i] - before[i];
      error += glm::dot(off, off);
      change += glm::dot(by, by);
    }
    EXPECT_GT(change, 0);
    EXPECT_LT(std::sqrt(error / change), shared::kViscosityRemaining) << viscosity;
  }
}

}  // namespace
}  // namespace rill::reference
