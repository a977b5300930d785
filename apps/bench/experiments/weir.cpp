// Flow over a sharp-crested weir across a whole channel: discharge over head against Rehbock's formula.
#include <cmath>

#include "bench/experiments/experiment.hpp"
#include "bench/experiments/inflow.hpp"

namespace rill::bench {
namespace {

constexpr double kWeirHigh = 0.3, kWeirHead = 0.2, kWeirLong = 0.9, kWeirPlate = 0.04;  // m
constexpr double kWeirEnd = 1.4, kWeirTop = 0.9;                                        // m, of the domain
constexpr double kWeirFrom = 3, kWeirUntil = 4.5;                                       // s
constexpr double kWeirSpacing[kLevels] = {kWeirHead / 10, kWeirHead / 14, kWeirHead / 20};

/// m^2/s; Rehbock 1929.
double rehbock(double head_m) {
  return 2.0 / 3 * (0.602 + 0.083 * head_m / kWeirHigh) * std::sqrt(2 * 9.81) * std::pow(head_m + 0.0012, 1.5);
}

Expected<Outcome> weir(const Bench& bench, double spacing) {
  const double wide = 6 * spacing, discharge = rehbock(kWeirHead), depth = kWeirHigh + kWeirHead, mouth = 0.8 * depth;
  Scene scene = boxScene(spacing, {0, 0, 0}, {kWeirEnd, kWeirTop, wide});
  scene.domain->open = 0b000010;
  scene.domain->open_removes = true;
  scene.duration = kWeirUntil;
  scene.solids = {boxSolid({kWeirLong, -0.1, -0.1}, {kWeirLong + kWeirPlate, kWeirHigh, wide + 0.1})};
  scene.fill.push_back(boxFill({spacing, 0, 0}, {kWeirLong, depth, wide}));
  scene.fill.back().velocity = {discharge / depth, 0, 0};
  scene.emitters = {inflowAlongX(spacing / 2, 0, mouth, wide, discharge / mouth)};
  // The nappe falls freely, with air on both sides.
  scene.drains = {{.name = "pit", .shape = BoxShape{{kWeirLong + kWeirPlate, 0, 0}, {kWeirEnd, kWeirHigh / 2, wide}}}};
  TimeMean head;
  std::vector<std::pair<double, double>> heads;
  auto run = runSampled(
      bench, scene, kWeirUntil, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        // Upstream of the fall of the surface to the crest, which begins two to three heads before it.
        const double found = slabMeans(cloud, 0.2, kWeirLong - 2 * kWeirHead, 0).depth() - kWeirHigh;
        heads.emplace_back(time, found);
        if (time >= kWeirFrom) head.add(found);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  outcome.figures.push_back(relativeFigure("head", head.value(), kWeirHead));
  outcome.figures.push_back(relativeFigure("discharge", discharge, rehbock(head.value())));
  outcome.curves["head_m"] = curveJson(heads);
  return outcome;
}

}  // namespace

std::vector<Experiment> weirExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"weir", level, level == 0, kWeirSpacing[level], [=](const Bench& bench) { return weir(bench, kWeirSpacing[level]); }});
  return all;
}

}  // namespace rill::bench
