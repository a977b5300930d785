// A long tank at rest whose end a tap fills for a while, with regions that sleep and without: the fluid has to end in the same state.
#include <algorithm>

#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

constexpr double kLakeLength = 2, kLakeWidth = 0.2, kLakeDepth = 0.24;  // m
constexpr double kLakeOpens = 7, kLakeCloses = 11, kLakeEnd = 17;       // s
constexpr double kLakeFlow = 2e-4;                                      // m^3/s
constexpr double kLakeSpacing[kLevels] = {0.025, 0.02, 0.016};

Expected<RunFigures> lakeRun(const Bench& bench, double spacing, bool sleeps) {
  Scene scene = boxScene(spacing, {0, 0, 0}, {kLakeLength, 2.5 * kLakeDepth, kLakeWidth});
  scene.fill = {boxFill({0, 0, 0}, {kLakeLength, kLakeDepth, kLakeWidth})};
  scene.duration = kLakeEnd;
  scene.solver.sleep = sleeps;
  scene.emitters = {{.name = "tap",
                     .mouth = DiscMouth{.center = {0.12, 1.5 * kLakeDepth, kLakeWidth / 2}, .radius = 0.02},
                     .flow = kLakeFlow,
                     .from = kLakeOpens,
                     .until = kLakeCloses}};
  return runSampled(
      bench, scene, kLakeEnd, 1.0 / 10, [](double) { return false; }, [](const Cloud&, double) {});
}

/// Largest share of the fluid that slept while the tap ran.
double asleepWhileOpen(const RunFigures& run) {
  double share = 0;
  for (const auto& [time, stats] : run.instants)
    if (time > kLakeOpens && time <= kLakeCloses) share = std::max(share, double(stats.sleeping.value_or(0)) / double(stats.particles));
  return share;
}

Expected<Outcome> lake(const Bench& bench, double spacing) {
  auto sleeps = lakeRun(bench, spacing, true), never = lakeRun(bench, spacing, false);
  if (!sleeps) return sleeps.error();
  if (!never) return never.error();
  Outcome outcome;
  if (sleeps->instants.empty() || never->instants.empty()) return outcome;  // stopped
  const offline::Stats &a = sleeps->instants.back().stats, &b = never->instants.back().stats;
  outcome.figures.push_back(relativeFigure("potential energy", a.potential_J, b.potential_J));
  outcome.figures.push_back(relativeFigure("mean height", a.centerOfMass[1], b.centerOfMass[1]));
  outcome.figures.push_back(plainFigure("mean place", (a.centerOfMass[0] - b.centerOfMass[0]) / spacing));
  outcome.figures.push_back(plainFigure("asleep, at most", asleepWhileOpen(*sleeps)));
  outcome.figures.push_back(plainFigure("time over that awake", sleeps->wall_s / never->wall_s));
  outcome.run = std::move(*sleeps);
  return outcome;
}

}  // namespace

std::vector<Experiment> lakeExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"lake", level, false, kLakeSpacing[level], [=](const Bench& bench) { return lake(bench, kLakeSpacing[level]); }});
  return all;
}

}  // namespace rill::bench
