// Walls as mirrors: what a particle counts behind them, and what that does to corrections.
#include "reference/images.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "reference/cloud.hpp"

namespace rill::reference {
namespace {

constexpr double kLayer = 0.05, kNone = std::numeric_limits<double>::infinity();

ReferenceSettings room(const glm::dvec3& size, double ratio) {
  ReferenceSettings s = tank(kLayer, size);
  s.smoothingRatio = ratio;
  return s;
}

// In boxes down to a single layer.
TEST(Images, CompleteTheRestLattice) {
  const glm::ivec3 boxes[] = {{10, 4, 5}, {3, 5, 8}, {4, 4, 4}, {2, 1, 3}, {1, 1, 1}, {1, 6, 6}};
  for (const double ratio : {1.2, 2.0, 2.3, 3.0, 4.0})
    for (const glm::ivec3& n : boxes) {
      ReferenceSolver solver(room(kLayer * glm::dvec3(n), ratio), lattice(n.x, n.y, n.z, kLayer));
      solver.density();
      for (size_t i = 0; i < solver.size(); ++i) {
        EXPECT_NEAR(solver.densityRatio()[i], 1, 1e-12) << n.x << " x " << n.y << " x " << n.z << " layers, h = " << ratio << " d";
        glm::dvec3 sum(0);
        for (const auto& pair : solver.pairs(i)) sum += pair.gradient;
        EXPECT_LT(glm::length(sum) * kLayer, 1e-12);
      }
    }
}

TEST(Images, NoneBehindOpenSides) {
  const Walls open{glm::dvec3(-kNone), glm::dvec3(kNone), kLayer / 2};
  EXPECT_TRUE(imagesNear({0, 0, 0}, open, 10 * kLayer).empty());
  const Walls floor{{-kNone, 0, -kNone}, glm::dvec3(kNone), kLayer / 2};
  const std::vector<Image> images = imagesNear({0.3, kLayer, 0.2}, floor, 2 * kLayer);
  ASSERT_EQ(images.size(), 1u);
  EXPECT_EQ(images[0].of({0.3, kLayer, 0.2}), glm::dvec3(0.3, -kLayer, 0.2));
  EXPECT_TRUE(imagesNear({0.3, 1.6 * kLayer, 0.2}, floor, 2 * kLayer).empty()) << "centers stay half a spacing off the wall";
}

// d rho_j / d x_i, by differences, is what the correction of i by the multiplier of j goes along: the gradient of the densities and the
// correction are adjoint, so that no closed loop of displacements beside a wall does work.
TEST(Images, CorrectionsAreTheGradientOfDensities) {
  ReferenceSettings s = room(kLayer * glm::dvec3(3.5, 4, 3), 2.3);
  ReferenceSolver solver(s, randomCloud(60, 0, 1));
  std::mt19937 random(5);
  for (glm::dvec3& x : solver.state.predicted)
    for (int a = 0; a < 3; ++a) x[a] = std::uniform_real_distribution<double>(s.lo[a] + kLayer / 2, s.hi[a] - kLayer / 2)(random);
  std::vector<double> weight(solver.size());
  for (double& w : weight) w = std::uniform_real_distribution<double>(-1, 1)(random);
  const auto energy = [&] {
    solver.density();
    double sum = 0;
    for (size_t i = 0; i < solver.size(); ++i) sum += weight[i] * solver.densityRatio()[i];
    return sum;
  };
  energy();
  std::vector<glm::dvec3> along(solver.size(), glm::dvec3(0));
  for (size_t i = 0; i < solver.size(); ++i)
    for (const auto& pair : solver.pairs(i)) along[i] += (weight[i] + weight[pair.j]) * pair.gradient;
  for (size_t i = 0; i < solver.size(); ++i)
    for (int a = 0; a < 3; ++a) {
      const double step = 1e-6 * kLayer, x = solver.state.predicted[i][a];
      solver.state.predicted[i][a] = x + step;
      const double above = energy();
      solver.state.predicted[i][a] = x - step;
      const double below = energy();
      solver.state.predicted[i][a] = x;
      EXPECT_NEAR(along[i][a] * kLayer, (above - below) / (2 * step) * kLayer, 1e-6);
    }
}

// A wave of shear between floor and ceiling is an eigenfunction of the lattice and its images: all of it decays alike, at walls too. So
// does one of motion toward them, faster. Judged in the middle, away from the free sides.
TEST(Images, ViscosityActsAlikeAtWalls) {
  ReferenceSettings s = room(kLayer * glm::dvec3(7, 8, 7), 2.3);
  for (const int a : {0, 2}) s.lo[a] = -kNone, s.hi[a] = kNone;
  s.viscosity = 500;
  s.viscositySteps = 1;  // explicit, so that the free sides have no influence
  ReferenceSolver solver(s, lattice(7, 8, 7, kLayer));
  const double wave = std::numbers::pi / s.hi.y;
  for (size_t i = 0; i < solver.size(); ++i) {
    const double y = solver.state.position[i].y;
    solver.state.velocity[i] = {std::cos(wave * y), std::sin(wave * y), 0};
  }
  const std::vector<glm::dvec3> before = solver.state.velocity;
  solver.density();
  solver.viscosity(1e-3);
  glm::dvec3 kept(0);
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 off = glm::abs(solver.state.position[i] - kLayer * glm::dvec3(3.5, 0, 3.5));
    if (std::max(off.x, off.z) > 0.1 * kLayer) continue;
    if (kept == glm::dvec3(0)) kept = solver.state.velocity[i] / before[i];
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(solver.state.velocity[i][a], kept[a] * before[i][a], 1e-12) << i;
  }
  EXPECT_LT(kept.x, 0.99);
  EXPECT_LT(kept.y, kept.x);
  EXPECT_GT(kept.y, 0.5);
}

}  // namespace
}  // namespace rill::reference
