// One slosh under settings of the solver.
#include <limits>

#include "bench/experiments/waves.hpp"

namespace rill::bench {

namespace {

constexpr double kCostFrom = 0.1;  // s: the start, which solves for the initial pressure, does not count

constexpr WaveSetting kComparedSettings[] = {
    {"default", "", true},
    {"h 2", "fluid.smoothing_ratio=2", true},
    {"h 2.5", "fluid.smoothing_ratio=2.5"},
    {"pressure 0.2", "fluid.tensile=0.2"},
    {"no noise damping", "solver.artificial_viscosity=0"},
    {"h 2, no noise damping", "fluid.smoothing_ratio=2 solver.artificial_viscosity=0"},
    {"tol 0.0004", "solver.tolerance=0.0004"},
    {"tol 0.003", "solver.tolerance=0.003", true},
    {"cfl 0.1", "solver.cfl=0.1"},
    {"grid", "solver.neighbors=grid"},
    {"paper's kernels", "solver.kernel=poly6_spiky"},
};

}  // namespace

std::span<const WaveSetting> comparedSettings() { return kComparedSettings; }

Expected<Outcome> runWaveSetting(const Bench& bench, const WaveSetting& setting, double periods) {
  const auto settings = waveSettings(setting.changes);
  if (!settings) return settings.error();
  WaveTank tank = deepTank(1, 0);
  tank.periods = periods;
  return releaseWave(bench, tank, *settings, "", "");
}

double settingCost(const RunFigures& run) {
  const double last = kCostFrom + deepTank(1, 0).wave.period();
  double wall = 0, simulated = 0, before = 0;
  for (const apps::Instant& instant : run.instants) {
    if (instant.time_s > last) return wall / simulated;
    if (before >= kCostFrom) {
      wall += instant.stats.wall_s;
      simulated += instant.time_s - before;
    }
    before = instant.time_s;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<Experiment> waveSettingExperiments() {
  std::vector<Experiment> all;
  constexpr double kSloshes = 4;  // periods
  const double spacing = deepTank(1, 0).spacing_m;
  for (const WaveSetting& setting : comparedSettings())
    all.push_back({std::string("setting ") + setting.name, 0, setting.quick, spacing,
                   [setting](const Bench& bench) { return runWaveSetting(bench, setting, kSloshes); }});
  return all;
}

}  // namespace rill::bench
