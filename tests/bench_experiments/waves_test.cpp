// The experiments of the suite `waves`: tanks, settings, costs, bands.
#include "bench/experiments/waves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/experiments/bands.hpp"

namespace rill::bench {
namespace {

TEST(WaveSuite, TanksHaveWholeSpacingsAndSmallWaves) {
  for (int mode = 1; mode <= 3; ++mode)
    for (unsigned level = 0; level < kLevels; ++level)
      for (const WaveTank& tank : {deepTank(mode, level), shallowTank(mode, level)}) {
        const double layers = tank.wave.depth_m / tank.spacing_m, columns = tank.wave.length_m / tank.spacing_m;
        EXPECT_NEAR(layers, std::round(layers), 1e-9);
        EXPECT_NEAR(columns, std::round(columns), 1e-9);
        const double particles = layers * columns * tank.thickness;
        EXPECT_GE(particles, 5000);
        EXPECT_LE(particles, 40000);
        EXPECT_LT(std::abs(tank.wave.secondOrder()), 0.006);
      }
  EXPECT_GT(std::tanh(deepTank(2, 0).wave.waveNumber() * deepTank(2, 0).wave.depth_m), 0.998);
  EXPECT_NEAR(shallowTank(1, 2).wave.waveNumber() * shallowTank(1, 2).wave.depth_m, 0.5, 0.02);
}

TEST(WaveSuite, SettingsAreSceneKeys) {
  for (const WaveSetting& setting : comparedSettings()) {
    const auto scene = waveSettings(setting.changes);
    EXPECT_TRUE(scene) << setting.name << ": " << scene.error().message;
  }
  const auto changed = waveSettings("fluid.smoothing_ratio=2.4 solver.neighbors=grid");
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->fluid.smoothing_ratio, 2.4);
  EXPECT_EQ(changed->solver.neighbors, NeighborChoice::Grid);
  EXPECT_FALSE(waveSettings("fluid.smothing_ratio=2.3"));
}

TEST(WaveSuite, SettingCostIsThatOfOnePeriodAfterStart) {
  const double period = deepTank(1, 0).wave.period();
  RunFigures run;
  for (int k = 0; k <= 150; ++k) {
    const double time = k / 60.0;
    run.instants.push_back({time, {}});
    run.instants.back().stats.wall_s = time < 0.11 || time > 0.1 + period ? 100 : 0.05;
  }
  EXPECT_NEAR(settingCost(run), 3, 1e-9);
  run.instants.resize(60);
  EXPECT_TRUE(std::isnan(settingCost(run)));
}

TEST(WaveSuite, FiguresHaveRowsOfBands) {
  for (const char* family : {"deep-mode-1", "shallow-mode-3", "viscosity-0.1", "setting h 2"})
    for (const char* figure : {"period", "loss a period"}) EXPECT_NE(bandOf(family, figure), nullptr) << family << ", " << figure;
  EXPECT_NE(bandOf("viscosity-0", "decay"), nullptr);
  for (const char* figure : {"speed", "speed at its height", "height kept"}) EXPECT_NE(bandOf("solitary-8", figure), nullptr) << figure;
  EXPECT_NE(bandOf("level-0.3", "shift"), nullptr);
}

}  // namespace
}  // namespace rill::bench
