#pragma once
// Experiments of the suite `waves`.
#include <span>
#include <string_view>

#include "bench/experiments/experiment.hpp"
#include "bench/experiments/wave_measures.hpp"
#include "bench/experiments/wave_theory.hpp"

namespace rill::bench {

/// A tank with a standing wave, at one resolution.
struct WaveTank {
  StandingWave wave;
  double spacing_m = 0;
  int thickness = 8;   ///< layers in z, between frictionless walls
  double periods = 5;  ///< duration, in periods of linear theory
};
/// The tanks of the suite: modes 1 to 3. Length 1 m; the amplitude is small enough for linear theory and large enough for particles.
WaveTank deepTank(int mode, unsigned level);     ///< depth 0.6 m
WaveTank shallowTank(int mode, unsigned level);  ///< depth 0.16 m

/// The tank, with fluid and solver of `settings` but its own spacing, and no particles.
Scene waveScene(const WaveTank& tank, const Scene& settings);

/// Releases the wave and fits a damped cosine to its modal amplitude. Figures: period, loss a period.
/// `settings` has the fluid and the solver; its spacing is replaced. `plot`: key of the diagram for the overlay; empty: none.
Expected<Outcome> releaseWave(const Bench& bench, const WaveTank& tank, const Scene& settings, const std::string& plot,
                              const std::string& label);

/// Fluid and solver with these scene keys changed, "key=value key=value".
Expected<Scene> waveSettings(std::string_view changes);

/// Settings of the solver that the suite compares.
struct WaveSetting {
  const char* name;     ///< short
  const char* changes;  ///< scene keys, as for waveSettings()
  bool quick = false;
};
std::span<const WaveSetting> comparedSettings();
/// One slosh of the deep tank with a setting, for `periods` of linear theory.
Expected<Outcome> runWaveSetting(const Bench& bench, const WaveSetting& setting, double periods);
/// Wall seconds per simulated second over a period of theory of that slosh, from 0.1 s on. NaN for a shorter run.
double settingCost(const RunFigures& run);

std::vector<Experiment> standingWaveExperiments();
std::vector<Experiment> viscousWaveExperiments();  ///< the first has no viscosity
std::vector<Experiment> solitaryWaveExperiments();
std::vector<Experiment> levelExperiments();
std::vector<Experiment> waveSettingExperiments();  ///< in the order of comparedSettings()

}  // namespace rill::bench
