// First standing wave of a tank: period against linear theory, damping against zero.
#include <algorithm>
#include <cmath>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"
#include "bench/experiments/wave_starts.hpp"

namespace rill::bench {
namespace {

constexpr double kLength = 1;                           // m
constexpr double kDepths[] = {0.25, 0.5, 1};            // m, as in sloshing_first_mode.csv
constexpr int kTankResolution[kLevels] = {20, 28, 40};  // spacings; multiples of 4, so that each depth is a multiple of the spacing
constexpr int kTankThickness = 4;                       // spacings in z, between frictionless walls
constexpr double kPeriods = 5.3;                        // long enough for ten crossings

Expected<Outcome> slosh(const Bench& bench, double depth, unsigned level) {
  const double spacing = kLength / kTankResolution[level];
  // Small enough for linear theory: below pi A / L = 0.13 the next order changes the period by less than 0.2 %.
  const StandingWave wave{.length_m = kLength, .depth_m = depth, .amplitude_m = std::min(0.04, 0.08 * depth)};
  const auto start = StartFile::write(standingWave(wave, spacing, kTankThickness));
  if (!start) return start.error();
  Scene scene = boxScene(spacing, {0, 0, 0}, {kLength, 2 * depth, kTankThickness * spacing});
  scene.fill.push_back(start->fill());
  const double expected = wave.period();
  auto run = runScene(bench, {.scene = scene, .duration_s = kPeriods * expected, .frame_s = 1.0 / 60});
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  Curve sway, drawn;
  for (const apps::Instant& instant : outcome.run.instants) sway.emplace_back(instant.time_s, instant.stats.centerOfMass[0] - kLength / 2);
  const double farthest = -2 * wave.amplitude_m / (std::pow(wave.waveNumber(), 2) * kLength * depth);  // linear theory
  for (const auto& [time, x] : sway) drawn.emplace_back(time / expected, x / farthest);
  const Oscillation found = oscillation(sway, expected / 8);
  outcome.figures.push_back(relativeFigure("period", found.period, expected));
  outcome.figures.push_back({"damping a period", found.decrement, 0, found.decrement});
  outcome.figures.push_back(plainFigure("energy, peak", outcome.run.energy.ratio - 1));
  outcome.curves["center_of_mass_x"] = curveJson(sway);
  outcome.curves["peaks"] = curveJson(found.peaks);
  outcome.overlays.push_back({"slosh", {"H = " + number(depth) + ", d = " + number(spacing), Series::Style::Lines, drawn, {}}});
  return outcome;
}

}  // namespace

std::vector<Experiment> sloshExperiments() {
  std::vector<Experiment> all;
  for (const double depth : kDepths)
    for (unsigned level = 0; level < kLevels; ++level)
      all.push_back({"slosh-" + number(depth), level, level == 0 && depth == kDepths[1], kLength / kTankResolution[level],
                     [=](const Bench& bench) { return slosh(bench, depth, level); }});
  return all;
}

}  // namespace rill::bench
