// Torricelli: a tank drains through a slit at its bottom.
#include <cmath>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

constexpr double kJetTank = 2, kJetDepth = 1, kJetSlit = 0.2, kJetWall = 0.2;  // m
constexpr double kJetFrom = 0.6, kJetTo = 1.2;                                 // s: after startup, before the head falls much
constexpr double kJetSpacing[kLevels] = {0.05, 1.0 / 30, 0.025};
constexpr int kJetThickness = 4;

Expected<Outcome> jet(const Bench& bench, unsigned level) {
  const double spacing = kJetSpacing[level], thick = kJetThickness * spacing;
  Scene scene = boxScene(spacing, {0, 0, 0}, {12, 2, thick});  // long enough that no fluid returns
  scene.fill.push_back(boxFill({0, 0, 0}, {kJetTank, kJetDepth, thick}));
  Solid wall;
  auto& box = wall.shape.emplace<BoxShape>();
  const double low[] = {kJetTank, kJetSlit, -1}, high[] = {kJetTank + kJetWall, 3, thick + 1};
  for (size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = low[axis];
    box.max[axis] = high[axis];
  }
  scene.solids.push_back(wall);
  Curve ratio, head, speeds, ideals, left;
  auto run = runSampled(
      bench, scene, kJetTo, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        // Samples the jet at the vena contracta, 0.5 to 2 slit heights behind the wall.
        double speed = 0, height = 0, count = 0, inside = 0;
        for (size_t i = 0; i < cloud.size(); ++i) {
          const double x = cloud.position[i][0];
          if (x < kJetTank) ++inside;
          if (x < kJetTank + kJetWall + 0.5 * kJetSlit || x > kJetTank + kJetWall + 2 * kJetSlit) continue;
          speed += cloud.velocity[i][0];
          height += cloud.position[i][1];
          ++count;
        }
        left.emplace_back(time, inside / double(cloud.size()));
        if (count == 0) return;
        // As under a sluice gate, the head is measured down to the jet's free surface, at twice the mean height of the jet.
        const double level_m = surfaceLevel(cloud, 0, 0, kJetTank / 2), ideal = std::sqrt(2 * 9.81 * (level_m - 2 * height / count));
        head.emplace_back(time, level_m);
        speeds.emplace_back(time, speed / count);
        ideals.emplace_back(time, ideal);
        ratio.emplace_back(time, speed / count / ideal);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  double sum = 0, ideal = 0, count = 0;
  for (size_t k = 0; k < ratio.size(); ++k)
    if (ratio[k].first >= kJetFrom) {
      sum += ratio[k].second;
      ideal += ideals[k].second;
      ++count;
    }
  outcome.figures.push_back(relativeFigure("speed over Torricelli's", sum / count, 1));
  // Outflow divided by that without contraction; 0.611 for a sharp edge in plane flow.
  const double volume = (at(left, kJetFrom) - at(left, kJetTo)) * kJetTank * kJetDepth;
  outcome.figures.push_back(relativeFigure("contraction", volume / (kJetSlit * (kJetTo - kJetFrom) * ideal / count), 0.611));
  outcome.curves["speed_m_s"] = curveJson(speeds);
  outcome.curves["level_m"] = curveJson(head);
  outcome.curves["ratio"] = curveJson(ratio);
  outcome.curves["share_left"] = curveJson(left);
  outcome.overlays.push_back({"jet", {"d = " + number(spacing) + " m", Series::Style::Lines, ratio, {}}});
  return outcome;
}

}  // namespace

std::vector<Experiment> jetExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"torricelli", level, level == 0, kJetSpacing[level], [level](const Bench& bench) { return jet(bench, level); }});
  return all;
}

}  // namespace rill::bench
