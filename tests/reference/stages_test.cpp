// Single stages of the reference solver: pairs, multipliers, correction, artificial pressure, vorticity, prediction.
#include <gtest/gtest.h>

#include "reference/crowded.hpp"
#include "reference/neighbors.hpp"

namespace rill::reference {
namespace {

TEST(Neighbors, GridMatchesBruteForce) {
  for (const glm::dvec3 from : {glm::dvec3(0), glm::dvec3(-0.3, -0.9, -0.1), glm::dvec3(1e5, -2e5, 3e4)}) {
    const std::vector<glm::dvec3> x = randomCloud(900, 0.8, 3, from);
    const Neighbors grid = findNeighbors(x, 0.1), all = findNeighborsBruteForce(x, 0.1);
    EXPECT_EQ(grid.first, all.first);
    EXPECT_EQ(grid.j, all.j);
    EXPECT_GT(grid.j.size(), 3000u);
  }
  EXPECT_EQ(findNeighbors({}, 0.1).first.size(), 1u);
}

TEST(Pairs, AreAntisymmetricIncludingCoincidentPairs) {
  ReferenceSolver solver = crowded(freeSpace());
  solver.density();
  int coincident = 0;
  for (uint32_t i = 0; i < solver.size(); ++i) {
    for (const auto& pair : solver.pairs(i)) {
      const auto back = std::find_if(solver.pairs(pair.j).begin(), solver.pairs(pair.j).end(), [&](const auto& p) { return p.j == i; });
      ASSERT_NE(back, solver.pairs(pair.j).end());
      EXPECT_EQ(pair.gradient, -back->gradient);
      EXPECT_EQ(pair.apart, -back->apart);
      EXPECT_EQ(pair.value, back->value);
      coincident += pair.apart != glm::dvec3(0);
    }
  }
  EXPECT_EQ(coincident, 2);
}

TEST(Correction, ConservesMomentum) {
  for (const KernelChoice kernel : {KernelChoice::Wendland, KernelChoice::Poly6Spiky}) {
    ReferenceSettings s = freeSpace();
    s.kernel = kernel;
    s.iterations = 3;
    s.tensile = 1;
    s.viscosity = 1;
    ReferenceSolver solver = crowded(s);
    const glm::dvec3 before = meanVelocity(solver);
    solver.begin(kStageStep);
    for (int step = 0; step < 5; ++step) solver.substep(kStageStep, kStageStep);
    EXPECT_LT(glm::length(meanVelocity(solver) - before), 1e-11 * rmsSpeed(solver));
    EXPECT_GT(rmsSpeed(solver), 5);  // the dense cloud expands
    EXPECT_EQ(solver.inactive(), 0u);
  }
}

TEST(Multipliers, AreNonPositiveAndReduceCompressionWithIterations) {
  double last = 1e9;
  for (const int iterations : {1, 2, 4, 8}) {
    ReferenceSettings s = tank(kStageSpacing, kStageSpacing * glm::dvec3(6, 9, 6));
    s.gravity = glm::dvec3(0);
    s.iterations = iterations;
    std::vector<glm::dvec3> x = lattice(6, 6, 6, kStageSpacing);
    const std::vector<glm::dvec3> jitter = randomCloud(x.size(), 0.4 * kStageSpacing, 9, glm::dvec3(-0.2 * kStageSpacing));
    for (size_t i = 0; i < x.size(); ++i) x[i] += jitter[i];
    ReferenceSolver solver(s, x);
    solver.begin(kStageStep);
    solver.substep(kStageStep, kStageStep);
    for (const double lambda : solver.lambda()) EXPECT_LE(lambda, 0);
    for (const double w : solver.state.warm) EXPECT_LE(w, 0);
    solver.density();
    EXPECT_LT(compression(solver), last);
    last = compression(solver);
  }
}

TEST(Multipliers, MatchFormula) {
  ReferenceSettings s = freeSpace();
  s.relaxation = 0.6;
  s.warmStart = 0.2;
  s.regularization = 0.1;
  ReferenceSolver solver = crowded(s);
  for (size_t i = 0; i < solver.size(); ++i) solver.state.warm[i] = -1e-5 * double(i);
  const std::vector<double> warm = solver.state.warm;
  solver.density();
  solver.multipliers(true);
  for (size_t i = 0; i < solver.size(); ++i) {
    double ratio = solver.kernel().value(0), squares = 0;
    glm::dvec3 own(0);
    for (size_t j = 0; j < solver.size(); ++j) {
      if (j == i) continue;
      const glm::dvec3 r = solver.state.predicted[i] - solver.state.predicted[j];
      ratio += solver.kernel().value(glm::length(r));
      const glm::dvec3 g = solver.kernel().gradientOverR(glm::length(r)) * r;
      own += g;
      squares += glm::dot(g, g);
    }
    if (i == 17 || i == 200) continue;  // the coincident pair
    const double delta = -0.6 * (ratio - 1) / (glm::dot(own, own) + squares + 0.1 * solver.kernel().restGradientSum());
    EXPECT_NEAR(solver.lambda()[i], std::min(0.0, warm[i] + delta), 1e-15);
    EXPECT_NEAR(solver.lambdaChange()[i], solver.lambda()[i] - warm[i], 1e-15);
    EXPECT_NEAR(solver.state.warm[i], std::min(0.0, warm[i] + 0.2 * (delta > 0 ? s.warmRelease : 1.0) * delta), 1e-15);
  }
}

TEST(Prediction, ScalesWarmStartBySquaredStep) {
  ReferenceSettings s = freeSpace();
  ReferenceSolver solver = crowded(s);
  std::fill(solver.state.warm.begin(), solver.state.warm.end(), -1e-5);
  solver.density();
  solver.predict(kStageStep, 2 * kStageStep);
  for (size_t i = 0; i < solver.size(); ++i) {
    EXPECT_NEAR(solver.state.warm[i], -4e-5, 1e-18);
    glm::dvec3 x = solver.state.position[i] + 2 * kStageStep * solver.state.velocity[i];
    for (const auto& pair : solver.pairs(i)) x -= 8e-5 * pair.gradient;
    EXPECT_LT(glm::length(solver.state.predicted[i] - x), 1e-14);
  }
}

TEST(ArtificialPressureStage, AccelerationIsIndependentOfStepAndScale) {
  // Acceleration of a pair at distance delta q, over g.
  const auto acceleration = [](double d, double dt) {
    ReferenceSettings s;
    s.spacing = d;
    s.tensile = 0.5;
    s.gravity = glm::dvec3(0);
    const double r = s.tensileRadius * s.smoothingRatio * d;
    ReferenceSolver solver(s, std::vector<glm::dvec3>{{0, 0, 0}, {r, 0, 0}});
    solver.begin(dt);
    solver.substep(dt, dt);
    EXPECT_LT(solver.state.velocity[0].x, 0);
    EXPECT_NEAR(solver.state.velocity[0].x, -solver.state.velocity[1].x, 1e-12);
    return -solver.state.velocity[0].x / dt / 9.81;
  };
  const double expected = acceleration(0.05, 1e-3);
  EXPECT_NEAR(acceleration(0.05, 4e-3), expected, 1e-9);
  EXPECT_NEAR(acceleration(0.0005, 1e-4), expected, 1e-9);
  EXPECT_NEAR(expected, 14.35, 0.1) << "half of strength 1";
}

TEST(ArtificialPressureStage, LimitsDisplacementToATwentiethOfASpacing) {
  ReferenceSettings s;
  s.spacing = 0.05;
  s.tensile = 0.1;
  s.gravity = glm::dvec3(0);
  ReferenceSolver solver(s, std::vector<glm::dvec3>{{0, 0, 0}, {0.02, 0, 0}});
  solver.begin(1);
  solver.substep(1, 1);
  EXPECT_NEAR(solver.state.position[1].x, 0.02 + 0.05 * s.spacing, 0.005 * s.spacing);
}

TEST(ArtificialPressureStage, IsConstantBelowReferenceAndZeroAtRest) {
  ReferenceSettings s;
  s.tensile = 0.5;
  s.tensileRadius = 0.3;
  ReferenceSolver solver(s, std::vector<glm::dvec3>{{0, 0, 0}});
  const auto kernel = [&](double q) { return solver.kernel().value(q * solver.kernel().h()); };
  const auto at = [&](double q) { return solver.artificialPressureTerm(kernel(q), 1e-3); };
  EXPECT_LT(at(0.3), 0);
  EXPECT_EQ(at(0.1), at(0.3));
  EXPECT_EQ(at(0), at(0.3));
  const double rest = std::pow(kernel(0.475) / kernel(0.3), s.tensilePower);  // 0.95 spacings
  EXPECT_NEAR(at(0.35) / at(0.3), (std::pow(kernel(0.35) / kernel(0.3), s.tensilePower) - rest) / (1 - rest), 1e-12);
  EXPECT_EQ(at(0.5), 0);
}

TEST(Vorticity, MeasuresCurlAndAcceleratesVortex) {
  ReferenceSettings s = freeSpace();
  s.vorticity = 0.3;
  const glm::dvec3 spin = {0, 3, 0};
  ReferenceSolver solver(s, lattice(16, 8, 16, kStageSpacing, kStageSpacing * glm::dvec3(-8, -4, -8)));
  solver.density();
  for (size_t i = 0; i < solver.size(); ++i) solver.state.velocity[i] = glm::cross(spin, solver.state.position[i]);
  solver.vorticity(kStageStep);
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 x = glm::abs(solver.state.position[i]);
    if (x.x < 5.6 * kStageSpacing && x.y < 1.6 * kStageSpacing && x.z < 5.6 * kStageSpacing) { EXPECT_NEAR(solver.curl()[i].y, 6, 0.6); }
  }
  // In a vortex that decays outward, the confinement force is along the flow outside of the core.
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 x = solver.state.position[i];
    solver.state.velocity[i] = glm::cross(spin, x) * std::exp(-(x.x * x.x + x.z * x.z) / (9 * kStageSpacing * kStageSpacing));
  }
  const std::vector<glm::dvec3> v = solver.state.velocity;
  solver.vorticity(kStageStep);
  double gain = 0;
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 x = glm::abs(solver.state.position[i]);
    if (x.y > 1.6 * kStageSpacing || std::hypot(x.x, x.z) > 4 * kStageSpacing) continue;
    gain += glm::dot(solver.state.velocity[i] - v[i], v[i]);
  }
  EXPECT_GT(gain, 0);
}

}  // namespace
}  // namespace rill::reference
