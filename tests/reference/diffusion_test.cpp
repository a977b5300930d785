// Diffusion in the reference solver: its rate in a lattice, what it conserves, and its bounds.
#include "sph/diffusion.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "reference/cloud.hpp"
#include "shared/diffusion_steps.h"

namespace rill::reference {
namespace {

constexpr double kDiffusingSpacing = 0.05;

/// A fluid that diffuses, and one that does not, at these places.
ReferenceSolver diffusing(const std::vector<glm::dvec3>& places, double diffusion, int stages) {
  ReferenceSettings s;
  s.spacing = kDiffusingSpacing;
  s.gravity = glm::dvec3(0);
  s.fluids = {{.diffusion = diffusion}, {}};
  s.diffusionStages = stages;
  ReferenceSolver solver(s, places);
  for (size_t i = 0; i < solver.size(); ++i) solver.state.fluid[i] = i % 2;
  return solver;
}

/// The rate at which a wave of the lattice decays over that of the exact solution.
double decayOverTheory(int spacings) {
  const double d = kDiffusingSpacing, k = 2 * std::numbers::pi / (spacings * d), diffusion = 1e-3, dt = 0.01;
  std::vector<glm::dvec3> places;
  const int half = 5;  // of the block across the wave: more than the support
  for (int x = 0; x < 3 * spacings; ++x)
    for (int y = -half; y <= half; ++y)
      for (int z = -half; z <= half; ++z) places.emplace_back(x * d, y * d, z * d);
  ReferenceSolver solver = diffusing(places, diffusion, 0);
  solver.begin(dt);
  auto& c = solver.state.concentration.front();
  for (size_t i = 0; i < places.size(); ++i) c[i] = std::cos(k * places[i].x);
  solver.diffuse(dt);
  double decayed = 0;
  for (size_t i = 0; i < places.size(); ++i)
    if (places[i].y == 0 && places[i].z == 0 && std::abs(places[i].x - spacings * d) < d / 2) decayed = -std::log(c[i]);
  return decayed / (diffusion * k * k * dt);
}

TEST(Diffusion, OfLongWavesHasItsDiffusivity) {
  EXPECT_NEAR(decayOverTheory(24), 1, 0.02);
  EXPECT_NEAR(decayOverTheory(12), 1, 0.06);
  EXPECT_LT(decayOverTheory(4), 0.85) << "waves as short as the support lose less";
}

TEST(Diffusion, KeepsWhatThereIsAndItsBounds) {
  for (const double diffusion : {1e-4, 1e-2, 1.0, 100.0}) {
    for (const int stages : {1, 2, 8, 16}) {
      ReferenceSolver solver = diffusing(randomCloud(300, 5.3 * kDiffusingSpacing, 5), diffusion, stages);
      solver.state.position[10] = solver.state.position[11];
      solver.begin(1e-3);
      const auto& c = solver.state.concentration.front();
      const double before = std::reduce(c.begin(), c.end());
      solver.diffuse(0.01);
      EXPECT_NEAR(std::reduce(c.begin(), c.end()), before, 1e-11 * before);
      for (const double each : c) EXPECT_TRUE(each > -1e-12 && each < 1 + 1e-12) << each << " of " << diffusion << " in " << stages;
    }
  }
}

TEST(Diffusion, InStagesIsNearManyShortSteps) {
  for (const double length : {0.9, 2.5, 9.0}) {
    ReferenceSolver exact = diffusing(randomCloud(300, 5.3 * kDiffusingSpacing, 5), 1, 0), staged = exact;
    staged.settings.diffusionStages = 16;
    exact.begin(1e-3);
    staged.begin(1e-3);
    const double dt = length / (diffusionRate(1, exact.kernel()) * 30);  // about: the row of the densest particle is near 30
    exact.diffuse(dt);
    staged.diffuse(dt);
    double squares = 0, most = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
      const double c = exact.state.concentration[0][i], difference = staged.state.concentration[0][i] - c;
      squares += difference * difference;
      most = std::max(most, std::abs(difference));
    }
    EXPECT_LT(std::sqrt(squares / double(exact.size())), 0.1) << length;
  }
}

TEST(Diffusion, TakesAsFewStagesAsItNeeds) {
  EXPECT_EQ(shared::diffusionStages(0.0, 32), 1u);
  EXPECT_EQ(shared::diffusionStages(1.0, 32), 1u);
  EXPECT_EQ(shared::diffusionStages(1.01, 32), 2u);
  EXPECT_EQ(shared::diffusionStages(2.01, 32), 4u);
  EXPECT_EQ(shared::diffusionStages(31.9, 32), 32u);
  EXPECT_EQ(shared::diffusionStages(1e30, 32), 32u);
  EXPECT_EQ(shared::diffusionStages(1e30, 1), 1u);
  EXPECT_EQ(shared::diffusionStages(std::numeric_limits<double>::quiet_NaN(), 8), 8u);
}

}  // namespace
}  // namespace rill::reference
