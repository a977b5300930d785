// A tap fills an empty tank: level = flow x time / area, once the water is at rest.
#include <variant>

#include "bench/experiments/experiment.hpp"
#include "bench/experiments/inflow.hpp"

namespace rill::bench {
namespace {

constexpr double kTapTank = 0.4, kTapDepth = 0.3;  // m
constexpr double kTapFrom = 0.1, kTapUntil = 2.1;  // s
constexpr double kTapFlow = kTapTank * kTapTank * kTapDepth / (kTapUntil - kTapFrom);
constexpr double kTapRestFrom = 4, kTapEnd = 5;  // s: the waves that the jet leaves have decayed by then
constexpr double kTapSpacing[kLevels] = {kTapTank / 16, kTapTank / 20, kTapTank / 28};

Expected<Outcome> tap(const Bench& bench, double spacing) {
  Scene scene = boxScene(spacing, {0, 0, 0}, {kTapTank, 2 * kTapDepth, kTapTank});
  scene.duration = kTapEnd;
  scene.emitters.push_back({.name = "tap",
                            .mouth = DiscMouth{.center = {0.4 * kTapTank, 1.5 * kTapDepth, 0.45 * kTapTank}, .radius = 0.06},
                            .flow = kTapFlow,
                            .from = kTapFrom,
                            .until = kTapUntil});
  scene.probes.push_back({.name = "tap", .flow = "tap"});
  constexpr int kProbes = 5;  // along each side
  for (int i = 0; i < kProbes; ++i)
    for (int j = 0; j < kProbes; ++j) {
      const double x = (i + 0.5) / kProbes * kTapTank, z = (j + 0.5) / kProbes * kTapTank;
      scene.probes.push_back({.name = "level " + std::to_string(kProbes * i + j), .level = std::pair{x, z}});
    }
  Outcome outcome;
  TimeMean depth, probes;
  std::vector<std::pair<double, double>> curve;
  auto run = runSampled(
      bench, scene, kTapEnd, 1.0 / 60, [](double time) { return time > kTapFrom; },
      [&](const Cloud& cloud, double time) {
        if (cloud.size() == 0) return;
        const double found = slabMeans(cloud, 0, kTapTank, 0).depth();
        curve.emplace_back(time, found);
        if (time > kTapRestFrom) depth.add(found);
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  double volume = 0;
  for (const apps::Instant& instant : outcome.run.instants)
    for (const auto& [name, value] : instant.stats.probes) {
      if (name == "tap")
        volume = std::get<offline::FlowValue>(value).volume;
      else if (instant.time_s > kTapRestFrom)
        probes.add(std::get<double>(value));
    }
  outcome.figures.push_back(relativeFigure("volume", volume, kTapFlow * (kTapUntil - kTapFrom)));
  outcome.figures.push_back(relativeFigure("level", depth.value(), kTapDepth));
  outcome.figures.push_back(relativeFigure("level, probes", probes.value(), kTapDepth));
  outcome.curves["twice_the_center_of_mass_m"] = curveJson(curve);
  return outcome;
}

}  // namespace

std::vector<Experiment> tapExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"tap", level, level == 0, kTapSpacing[level], [=](const Bench& bench) { return tap(bench, kTapSpacing[level]); }});
  return all;
}

}  // namespace rill::bench
