// A jet from a square hole in the floor of a tank that an emitter and an overflow keep full: speed against Torricelli's.
#include <cmath>

#include "bench/experiments/experiment.hpp"
#include "bench/experiments/inflow.hpp"

namespace rill::bench {
namespace {

// A quarter of the tank: two of its walls, which have no friction, are its planes of symmetry.
constexpr double kHoleTank = 0.4, kHoleDepth = 0.8, kHole = 0.1, kHolePlate = 0.05;  // m; half widths of the tank and of the hole
constexpr double kHoleFeed = 1.15;                                                   // over the outflow that is expected
constexpr double kHoleContraction = 0.61;                                            // of a sharp edge
constexpr double kHoleOverflow = 0.15;                                               // m along x, above the level; the mouth has the rest
constexpr double kHoleFrom = 0.8, kHoleEnd = 1.8;                                    // s
constexpr double kHoleSpacing[kLevels] = {kHole / 4, kHole / 6, kHole / 8};

Scene orificeScene(double spacing) {
  constexpr double kBelow = 0.5, kAbove = 0.2;
  Scene scene = boxScene(spacing, {0, -kBelow, 0}, {kHoleTank, kHoleDepth + kAbove, kHoleTank});
  scene.domain->open = 0b000100;
  scene.domain->open_removes = true;
  scene.duration = kHoleEnd;
  scene.fill.push_back(boxFill({0, 0, 0}, {kHoleTank, kHoleDepth, kHoleTank}));
  scene.solids = {boxSolid({kHole, -kHolePlate, -kHole}, {kHoleTank + kHole, 0, kHoleTank + kHole}),
                  boxSolid({-kHole, -kHolePlate, kHole}, {kHole, 0, kHoleTank + kHole})};
  const double outflow = kHoleContraction * kHole * kHole * std::sqrt(2 * 9.81 * kHoleDepth);
  scene.emitters = {{.mouth = RectMouth{.center = {(kHoleOverflow + kHoleTank) / 2, kHoleDepth, kHoleTank / 2},
                                        .size = {kHoleTank - kHoleOverflow, kHoleTank},
                                        .normal = {0, -1, 0},
                                        .up = {0, 0, 1}},
                     .flow = kHoleFeed * outflow}};
  scene.drains = {{.name = "overflow", .shape = BoxShape{{0, kHoleDepth, 0}, {kHoleOverflow, kHoleDepth + kAbove, kHoleTank}}}};
  return scene;
}

Expected<Outcome> orifice(const Bench& bench, double spacing) {
  const Scene scene = orificeScene(spacing);
  // Behind the plate the jet contracts within half of the hole's width.
  const double top = -kHolePlate - kHole, bottom = -kHolePlate - 3.5 * kHole;
  TimeMean ratio, level, overflow;
  std::vector<std::pair<double, double>> levels, ratios;
  auto run = runSampled(
      bench, scene, kHoleEnd, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const double depth = slabMeans(cloud, 0, kHoleOverflow, 0).depth();
        TimeMean jet;
        for (size_t i = 0; i < cloud.size(); ++i) {
          const double y = cloud.position[i].y;
          if (y > bottom && y < top)
            jet.add(std::hypot(cloud.velocity[i].x, cloud.velocity[i].y, cloud.velocity[i].z) / std::sqrt(2 * 9.81 * (depth - y)));
        }
        levels.emplace_back(time, depth);
        ratios.emplace_back(time, jet.value());
        if (time < kHoleFrom) return;
        level.add(depth);
        ratio.add(jet.value());
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  const apps::Instant *first = nullptr, *last = &outcome.run.instants.back();
  for (const apps::Instant& instant : outcome.run.instants)
    if (!first && instant.time_s >= kHoleFrom) first = &instant;
  const double volume = double(last->stats.ledger.left - first->stats.ledger.left) * std::pow(spacing, 3);
  const double flow = volume / (last->time_s - first->time_s);
  outcome.figures.push_back(relativeFigure("level", level.value(), kHoleDepth));
  outcome.figures.push_back(relativeFigure("jet, speed", ratio.value(), 1));
  outcome.figures.push_back(relativeFigure("contraction", flow / (kHole * kHole * std::sqrt(2 * 9.81 * level.value())), kHoleContraction));
  outcome.curves["level_m"] = curveJson(levels);
  outcome.curves["ratio"] = curveJson(ratios);
  return outcome;
}

}  // namespace

std::vector<Experiment> orificeExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back(
        {"orifice", level, level == 0, kHoleSpacing[level], [=](const Bench& bench) { return orifice(bench, kHoleSpacing[level]); }});
  return all;
}

}  // namespace rill::bench
