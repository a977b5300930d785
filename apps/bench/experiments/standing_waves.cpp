// Standing waves of a tank: period against linear theory, amplitude lost, decay with viscosity.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "bench/experiments/start_file.hpp"
#include "bench/experiments/wave_starts.hpp"
#include "bench/experiments/waves.hpp"

namespace rill::bench {
namespace {

constexpr double kWaveTank = 1;  // m
constexpr int kModes = 3;
constexpr int kDeepColumns[kLevels] = {30, 45, 60};  // with depths of 18, 27 and 36 layers
constexpr int kDeepThickness[kLevels] = {10, 8, 6};
constexpr int kShallowColumns[kLevels] = {50, 75, 112};  // with depths of 8, 12 and 18 layers
constexpr int kShallowThickness[kLevels] = {14, 8, 6};
constexpr double kSteepest = 0.12, kHighest = 0.1;  // k A and A / h: the second order changes the frequency by 0.5 % at most

// Small, so that viscosity takes a share of the wave that can be measured.
constexpr double kViscousTank = 0.1;                  // m
constexpr double kViscosities[] = {0, 0.01, 0.1, 1};  // Pa s
constexpr int kViscousColumns = 30, kViscousLayers = 18;

WaveTank waveTank(int mode, int columns, int layers, int thickness) {
  WaveTank tank;
  tank.spacing_m = kWaveTank / columns;
  tank.thickness = thickness;
  tank.wave = {.length_m = kWaveTank, .depth_m = layers * tank.spacing_m, .mode = mode};
  tank.wave.amplitude_m = std::min(kSteepest / tank.wave.waveNumber(), kHighest * tank.wave.depth_m);
  return tank;
}

}  // namespace

WaveTank deepTank(int mode, unsigned level) {
  return waveTank(mode, kDeepColumns[level], kDeepColumns[level] * 3 / 5, kDeepThickness[level]);
}

WaveTank shallowTank(int mode, unsigned level) {
  constexpr int kLayers[kLevels] = {8, 12, 18};
  return waveTank(mode, kShallowColumns[level], kLayers[level], kShallowThickness[level]);
}

Expected<Scene> waveSettings(std::string_view changes) {
  std::vector<Override> overrides;
  while (!changes.empty()) {
    const size_t end = std::min(changes.find(' '), changes.size());
    auto change = parseOverride(changes.substr(0, end));
    if (!change) return change.error();
    overrides.push_back(std::move(*change));
    changes.remove_prefix(std::min(end + 1, changes.size()));
  }
  return parseScene(R"({"rill": "0.1", "fluid": {"spacing": 1}})", "waves", std::filesystem::path("."), overrides);
}

Scene waveScene(const WaveTank& tank, const Scene& settings) {
  Scene scene = boxScene(tank.spacing_m, {0, 0, 0}, {tank.wave.length_m, 2 * tank.wave.depth_m, tank.thickness * tank.spacing_m});
  scene.fluid = settings.fluid;
  scene.fluid.spacing = tank.spacing_m;
  scene.solver = settings.solver;
  return scene;
}

Expected<Outcome> releaseWave(const Bench& bench, const WaveTank& tank, const Scene& settings, const std::string& plot,
                              const std::string& label) {
  const StandingWave& wave = tank.wave;
  const auto start = StartFile::write(standingWave(wave, tank.spacing_m, tank.thickness));
  if (!start) return start.error();
  Scene scene = waveScene(tank, settings);
  scene.fill.push_back(start->fill());
  Curve amplitude;  // m over s
  auto run = runSampled(
      bench, scene, tank.periods * wave.period(), std::min(1.0 / 60, wave.period() / 24), [](double) { return true; },
      [&](const Cloud& cloud, double time) { amplitude.emplace_back(time, modalAmplitude(cloud, wave.waveNumber(), wave.depth_m)); });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  const DampedCosine fit = fitDampedCosine(amplitude, wave.frequency());
  outcome.figures.push_back(relativeFigure("period", fit.period(), wave.period()));
  outcome.figures.push_back(plainFigure("loss a period", 1 - fit.keptPerPeriod()));
  outcome.curves["amplitude_m"] = curveJson(amplitude);
  outcome.curves["fit"] = {{"decay_per_s", fit.decay}, {"offset_m", fit.offset}, {"residual", fit.residual}};
  outcome.curves["second_order"] = wave.secondOrder();
  Curve drawn;
  for (const auto& [time, value] : amplitude) drawn.emplace_back(time / wave.period(), value / wave.amplitude_m);
  if (!plot.empty()) outcome.overlays.push_back({plot, {label, Series::Style::Lines, drawn, {}}});
  return outcome;
}

std::vector<Experiment> standingWaveExperiments() {
  std::vector<Experiment> all;
  for (const bool deep : {true, false})
    for (int mode = 1; mode <= kModes; ++mode)
      for (unsigned level = 0; level < kLevels; ++level) {
        const WaveTank tank = deep ? deepTank(mode, level) : shallowTank(mode, level);
        const std::string name = deep ? "deep" : "shallow";
        all.push_back(
            {name + "-mode-" + std::to_string(mode), level, level == 0 && mode == 1, tank.spacing_m,
             [=](const Bench& bench) -> Expected<Outcome> {
               // One resolution is enough for the diagram of amplitudes.
               auto outcome = releaseWave(bench, tank, Scene(), level == 1 || bench.quick() ? "amplitude-" + name : "",
                                          "mode " + std::to_string(mode));
               if (!outcome || outcome->figures.empty()) return outcome;
               const StandingWave& wave = tank.wave;
               const double measured = 2 * std::numbers::pi / outcome->figures[0].measured;
               const std::string label = name + ", L = " + number(wave.length_m / tank.spacing_m) + " d";
               const double kh = wave.waveNumber() * wave.depth_m;
               outcome->overlays.push_back(
                   {"dispersion", {label, Series::Style::Points, {{kh, measured / std::sqrt(wave.gravity * wave.waveNumber())}}, {}}});
               return outcome;
             }});
      }
  return all;
}

std::vector<Experiment> viscousWaveExperiments() {
  WaveTank tank;
  tank.spacing_m = kViscousTank / kViscousColumns;
  tank.thickness = kDeepThickness[0];
  tank.wave = {.length_m = kViscousTank, .depth_m = kViscousLayers * tank.spacing_m};
  tank.wave.amplitude_m = kSteepest / tank.wave.waveNumber();
  std::vector<Experiment> all;
  for (const double viscosity : kViscosities)
    all.push_back({"viscosity-" + number(viscosity), 0, false, tank.spacing_m, [=](const Bench& bench) {
                     Scene settings;
                     settings.fluid.viscosity = viscosity;
                     auto outcome = releaseWave(bench, tank, settings, "amplitude-viscous", number(viscosity) + " Pa s");
                     if (!outcome || outcome->figures.empty()) return outcome;
                     const double decay = outcome->curves["fit"]["decay_per_s"],
                                  expected =
                                      viscousDecay(viscosity / settings.fluid.density, tank.wave.waveNumber(), tank.wave.frequency());
                     outcome->figures.push_back({"decay", decay, expected, decay - expected});
                     return outcome;
                   }});
  return all;
}

}  // namespace rill::bench
