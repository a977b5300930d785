// Figures of a whole run.
#include "shared/run_figures.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rill::apps {
namespace {

// What has left a domain of 1 m is no energy gained: gravity of 10 m/s^2 along +y, so that its lowest place is at y = 1.
TEST(RunFigures, EnergyIsThatOfTheFluidThatIsThere) {
  Scene scene;
  scene.gravity = {0, 10, 0};
  scene.domain = Domain{{0, 0, 0}, {1, 1, 1}};
  scene.fluid.spacing = 0.1;  // particles of 1 kg
  const auto at = [](double time_s, uint64_t particles, double height, double kinetic_J) {
    Instant instant{.time_s = time_s};
    instant.stats.particles = particles;
    instant.stats.potential_J = -10 * double(particles) * height;
    instant.stats.kinetic_J = kinetic_J;
    return instant;
  };
  const std::vector<Instant> drains = {at(0, 8, 0.5, 0), at(1, 4, 0.75, 10), at(2, 1, 1, 0)};
  EXPECT_NEAR(energyFigures(scene, drains).ratio, 1, 1e-9);
  EXPECT_NEAR(energyFigures(scene, drains).end_ratio, 0, 1e-9);

  const std::vector<Instant> gains = {at(0, 8, 0.5, 0), at(1, 8, 0.5, 10), at(2, 8, 0.5, 5)};
  EXPECT_NEAR(energyFigures(scene, gains).ratio, 1.25, 1e-9);
  EXPECT_NEAR(energyFigures(scene, gains).end_ratio, 1.125, 1e-9);
}

// Masses are those of the fluids: here the heavy half drains from the middle, and the light one stays there.
TEST(RunFigures, EnergyIsThatOfEachFluid) {
  Scene scene;
  scene.gravity = {0, 10, 0};
  scene.domain = Domain{{0, 0, 0}, {1, 1, 1}};
  scene.fluid.spacing = 0.1;
  scene.fluids = {{.name = "water", .density = 1000}, {.name = "oil", .density = 500}};
  const auto at = [](double time_s, uint64_t water) {
    Instant instant{.time_s = time_s};
    instant.stats.fluids.resize(2);
    instant.stats.fluids[0].particles = water;
    instant.stats.fluids[1].particles = 4;
    instant.stats.particles = water + 4;
    instant.stats.potential_J = -10 * (double(water) + 0.5 * 4) * 0.5;
    return instant;
  };
  const std::vector<Instant> run = {at(0, 4), at(1, 0)};
  EXPECT_NEAR(energyFigures(scene, run).ratio, 1, 1e-9);
  EXPECT_NEAR(energyFigures(scene, run).end_ratio, 1.0 / 3, 1e-9);
}

}  // namespace
}  // namespace rill::apps
