// A tank whose gravity is tilted: how far its center of mass moves, against hydrostatics.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/experiments/waves.hpp"

namespace rill::bench {
namespace {

constexpr int kLevelColumns = 88, kLevelLayers = 18, kLevelThickness = 4;
constexpr double kLevelSpacing = 0.02;  // m
constexpr double kJudged = 8;           // s: middle of the window over which the mean is taken
constexpr double kPeriodsAfter = 1.1;   // of theory, simulated after that: room for slow waves
// Degrees. Shares of neighboring tilts differ by up to a tenth: docs/notes/waves-suite.md.
constexpr double kTilts[] = {0.28, 0.3, 0.32, 0.09, 0.1, 0.11};

Expected<Outcome> level(const Bench& bench, double degrees) {
  const StandingWave slosh{.length_m = kLevelColumns * kLevelSpacing, .depth_m = kLevelLayers * kLevelSpacing};
  const double width = kLevelThickness * kLevelSpacing, angle = degrees * std::numbers::pi / 180;
  Scene scene = boxScene(kLevelSpacing, {0, 0, 0}, {slosh.length_m, 2 * slosh.depth_m, width});
  scene.gravity = {slosh.gravity * std::sin(angle), -slosh.gravity * std::cos(angle), 0};
  scene.fill.push_back(boxFill({0, 0, 0}, {slosh.length_m, slosh.depth_m, width}));
  auto run = runScene(bench, {.scene = scene, .duration_s = kJudged + kPeriodsAfter * slosh.period(), .frame_s = 1.0 / 60});
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  const double expected = levelShift(slosh.length_m, slosh.depth_m, std::tan(angle));
  Curve moved, share;
  for (const apps::Instant& instant : outcome.run.instants)
    moved.emplace_back(instant.time_s, instant.stats.centerOfMass[0] - outcome.run.instants.front().stats.centerOfMass[0]);
  for (const auto& [time, distance] : moved) share.emplace_back(time, distance / expected);
  // Two periods of the slosh that the tilt excites, as it is: the window takes that out.
  const double half = std::min(fitDampedCosine(moved, slosh.frequency()).period(), kPeriodsAfter * slosh.period());
  outcome.figures.push_back(relativeFigure("shift", windowMean(moved, kJudged - half, kJudged + half), expected));
  outcome.curves["shift_m"] = curveJson(moved);
  outcome.overlays.push_back({"level", {number(degrees) + " degrees", Series::Style::Lines, share, {}}});
  return outcome;
}

}  // namespace

std::vector<Experiment> levelExperiments() {
  std::vector<Experiment> all;
  for (const double degrees : kTilts)
    all.push_back({"level-" + number(degrees), 0, false, kLevelSpacing, [degrees](const Bench& bench) { return level(bench, degrees); }});
  return all;
}

}  // namespace rill::bench
