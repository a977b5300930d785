// Viscosity that depends on shear in the reference: rates, momenta, and profiles between plates.
#include "sph/shear_viscosity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "reference/cloud.hpp"

namespace rill::reference {
namespace {

constexpr double kShearedSpacing = 0.01, kShearedStep = 4e-3;

ReferenceSettings sheared(const Rheology& rheology) {
  ReferenceSettings s;
  s.spacing = kShearedSpacing;
  s.smoothingRatio = 2.3;
  s.gravity = glm::dvec3(0);
  s.shearViscosity = true;
  s.viscosity = largestViscosity(rheology);
  s.fluids = {
      {.density = s.density, .viscosity = rheology.consistency, .yieldStress = rheology.yieldStress, .flowIndex = rheology.flowIndex}};
  return s;
}

/// Points of a lattice, moved by up to a fifth of a spacing.
std::vector<glm::dvec3> disordered(int n) {
  std::vector<glm::dvec3> x = lattice(n, n, n, kShearedSpacing, glm::dvec3(-0.5 * n * kShearedSpacing));
  const std::vector<glm::dvec3> by = randomCloud(x.size(), 0.4 * kShearedSpacing, 3, glm::dvec3(-0.2 * kShearedSpacing));
  for (size_t i = 0; i < x.size(); ++i) x[i] += by[i];
  return x;
}

// Inside and at the surface. A free surface halves the neighbors, not the rate.
TEST(ShearViscosity, FindsTheRateOfALinearFlow) {
  const glm::dmat3 flow(0.3, 2, -0.4, 1, -0.5, 0.7, 0, 1.5, 0.2);  // without divergence
  const glm::dmat3 strain = 0.5 * (flow + glm::transpose(flow));
  double expected = 0;
  for (int a = 0; a < 3; ++a) expected += 2 * glm::dot(strain[a], strain[a]);
  expected = std::sqrt(expected);
  ReferenceSolver solver(sheared({1, 10, 1}), disordered(11));
  solver.density();
  std::vector<glm::dvec3> v;
  for (const glm::dvec3& x : solver.state.predicted) v.push_back(flow * x + glm::cross(glm::dvec3(5, -7, 9), x));
  double inside = 0, outside = 0, worst = 0, insideCount = 0, outsideCount = 0;
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 x = glm::abs(solver.state.predicted[i]) / kShearedSpacing;
    const double rate = solver.shearRate(i, v) / expected;
    const bool deep = std::max({x.x, x.y, x.z}) < 3;
    (deep ? inside : outside) += rate;
    ++(deep ? insideCount : outsideCount);
    worst = std::max(worst, std::abs(rate - 1));
  }
  EXPECT_NEAR(inside / insideCount, 1, 0.02);
  EXPECT_NEAR(outside / outsideCount, 1, 0.03);
  EXPECT_LT(worst, 0.35) << "at edges and corners";
}

TEST(ShearViscosity, RigidMotionHasNoRate) {
  ReferenceSolver solver(sheared({1, 10, 1}), disordered(5));
  solver.density();
  std::vector<glm::dvec3> v;
  for (const glm::dvec3& x : solver.state.predicted) v.push_back(glm::dvec3(1, 2, 3) + glm::cross(glm::dvec3(5, -7, 9), x));
  for (size_t i = 0; i < solver.size(); ++i) EXPECT_LT(solver.shearRate(i, v), 1e-10) << i;
}

/// Speeds of layers between plates that a body force moves (m/s^2), in the middle of a lattice.
std::vector<double> profileBetweenPlates(const Rheology& rheology, int layers, double force, double seconds, int steps) {
  const int wide = 11;
  ReferenceSettings s = sheared(rheology);
  s.noSlipWalls = true;
  s.lo.y = 0;
  s.hi.y = layers * kShearedSpacing;
  s.viscositySteps = steps;
  ReferenceSolver solver(s, lattice(wide, layers, wide, kShearedSpacing));
  solver.density();
  // The field is that of the middle column, so that the sides of the block, which lack neighbors, have no influence.
  std::vector<double> column(layers, 0);
  const auto middle = [&](int j) { return static_cast<size_t>((wide / 2 * layers + j) * wide + wide / 2); };
  for (double t = 0; t < seconds; t += kShearedStep) {
    for (size_t i = 0; i < solver.size(); ++i) solver.state.velocity[i] = {column[(i / wide) % layers] + force * kShearedStep, 0, 0};
    solver.viscosity(kShearedStep);
    for (int j = 0; j < layers; ++j) column[j] = solver.state.velocity[middle(j)].x;
  }
  return column;
}

/// Of Herschel and Bulkley between plates, at y from the middle, half of the gap `a`, for a force on mass.
double exactSpeed(const Rheology& r, double density, double force, double a, double y) {
  const double gradient = density * force, plug = std::min(r.yieldStress / gradient, a), e = 1 / r.flowIndex + 1;
  const auto term = [&](double from) { return std::pow(std::max(from - plug, 0.0), e); };
  return std::pow(gradient / r.consistency, 1 / r.flowIndex) / e * (term(a) - term(std::abs(y)));
}

// Half of the error is that of the sides, which lack neighbors.
TEST(ShearViscosity, FluidsBetweenPlatesHaveTheirProfile) {
  constexpr int kLayers = 8;
  const double a = kLayers * kShearedSpacing / 2;
  for (const Rheology& rheology : {Rheology{5, 20, 1}, Rheology{10, 0, 0.5}, Rheology{2, 0, 1.5}}) {
    const double e = 1 / rheology.flowIndex + 1;
    const double force = rheology.yieldStress > 0 ? rheology.yieldStress / (0.4 * a * 1000)
                                                  : rheology.consistency * std::pow(0.1 * e / std::pow(a, e), rheology.flowIndex) / 1000;
    const double top = exactSpeed(rheology, 1000, force, a, 0);
    const std::vector<double> column = profileBetweenPlates(rheology, kLayers, force, 1, 64);
    for (int j = 0; j < kLayers; ++j)
      EXPECT_NEAR(column[j], exactSpeed(rheology, 1000, force, a, (j + 0.5) * kShearedSpacing - a), 0.1 * top)
          << rheology.flowIndex << " " << j;
  }
}

ReferenceSolver stirred(const Rheology& rheology, int steps) {
  ReferenceSettings s = sheared(rheology);
  s.viscositySteps = steps;
  if (steps > 0) s.shearBound = 0.99 * reachedBound(static_cast<unsigned>(steps));
  return {s, randomCloud(300, 5.3 * kShearedSpacing, 5), randomCloud(300, 2, 6, glm::dvec3(-1))};
}

TEST(ShearViscosity, ConservesMomentaAndDissipatesEnergy) {
  for (const Rheology& rheology : {Rheology{10, 0, 0.4}, Rheology{1, 200, 1}, Rheology{0, 1e6, 1}, Rheology{1, 0, 2}})
    for (const int steps : {0, 5, 64}) {
      ReferenceSolver solver = stirred(rheology, steps);
      solver.density();
      const auto turning = [&] {
        glm::dvec3 sum(0);
        for (size_t i = 0; i < solver.size(); ++i) sum += glm::cross(solver.state.predicted[i], solver.state.velocity[i]);
        return sum;
      };
      const glm::dvec3 before = meanVelocity(solver), turned = turning();
      double kinetic = rmsSpeed(solver);
      for (int n = 0; n < 3; ++n) {
        solver.viscosity(kShearedStep);
        EXPECT_LT(rmsSpeed(solver), kinetic) << rheology.yieldStress << " " << steps;
        kinetic = rmsSpeed(solver);
      }
      EXPECT_LT(glm::length(meanVelocity(solver) - before), 1e-12) << rheology.yieldStress << " " << steps;
      EXPECT_LT(glm::length(turning() - turned), 1e-9) << rheology.yieldStress << " " << steps;
    }
}

TEST(ShearViscosity, FallsFreelyFromTheVelocitiesBefore) {
  ReferenceSettings s = sheared({1, 1e6, 1});
  s.gravity = {0, -9.81, 0};
  s.viscositySteps = 64;
  s.shearBound = 0.99 * reachedBound(64);
  std::vector<glm::dvec3> x = disordered(5);
  for (glm::dvec3& at : x) at *= 1.2;  // under no pressure, whose forces need not sum to zero under gravity
  ReferenceSolver solver(s, x);
  solver.begin(kShearedStep);
  for (int n = 0; n < 10; ++n) solver.substep(kShearedStep, kShearedStep);
  EXPECT_NEAR(meanVelocity(solver).y, -9.81 * 10 * kShearedStep, 1e-9);
}

}  // namespace
}  // namespace rill::reference
