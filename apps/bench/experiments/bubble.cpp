// A bubble that rises in a slab of thick liquid: the first case of Hysing et al. 2009 (doi 10.1002/fld.1934), six spacings thick.
#include <algorithm>
#include <cmath>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"

namespace rill::bench {
namespace {

// SI units; the published figures are those of three finite-element programs, which agree.
constexpr double kLid = 2.4;  // m: in a box without room, particles hardly pass each other
constexpr double kTankWide = 1, kHigh = 2, kRadius = 0.25, kBubbleGravity = 0.98, kRiseEnd = 3, kLiquidDensity = 1000,
                 kLiquidViscosity = 10;
constexpr double kRiseSpacing[kLevels] = {1.0 / 24, 1.0 / 32, 1.0 / 40};

constexpr double kBubbleDensity = 100, kBubbleViscosity = 1, kBubbleTension = 24.5;
constexpr double kLargestRise = 0.2417, kCenterAtEnd = 1.0813;

Expected<Outcome> risingBubble(const Bench& bench, unsigned level) {
  const double spacing = kRiseSpacing[level], thick = 6 * spacing;
  Scene slab = boxScene(spacing, {0, 0, 0}, {kTankWide, kLid, thick});
  slab.gravity = {0, -kBubbleGravity, 0};
  slab.fluids = {{.name = "liquid", .density = kLiquidDensity, .viscosity = kLiquidViscosity},
                 {.name = "bubble", .density = kBubbleDensity, .viscosity = kBubbleViscosity}};
  slab.interfaces = {{.between = {"liquid", "bubble"}, .tension = kBubbleTension}};
  Cloud liquid{.position = {}, .velocity = {}, .spacing = spacing}, bubble = liquid;
  const auto cells = [&](double length) { return static_cast<int>(std::round(length / spacing)); };
  for (int i = 0; i < cells(kTankWide); ++i)
    for (int j = 0; j < cells(kHigh); ++j)
      for (int n = 0; n < cells(thick); ++n) {
        const Double3 x{(i + 0.5) * spacing, (j + 0.5) * spacing, (n + 0.5) * spacing};
        Cloud& own = std::hypot(x.x - kTankWide / 2, x.y - 2 * kRadius) < kRadius ? bubble : liquid;
        own.position.push_back(x);
        own.velocity.push_back({});
      }
  const auto around = StartFile::write(liquid), inside = StartFile::write(bubble);
  if (!around) return around.error();
  if (!inside) return inside.error();
  slab.fill = {around->fill(), inside->fill()};
  slab.fill.back().fluid = "bubble";
  for (Fill& fill : slab.fill) fill.jitter = 0.2;
  const size_t first = liquid.size();

  Curve heights, speeds;
  auto run = runSampled(
      bench, slab, kRiseEnd, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        double height = 0, speed = 0;
        const double count = double(cloud.size() - first);
        for (size_t i = first; i < cloud.size(); ++i) {
          height += cloud.position[i].y / count;
          speed += cloud.velocity[i].y / count;
        }
        heights.emplace_back(time, height);
        speeds.emplace_back(time, speed);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  outcome.curves["height"] = curveJson(heights);
  outcome.curves["speed"] = curveJson(speeds);
  double fastest = 0;  // over a tenth of a second, longer than what lone particles add
  for (size_t i = 0; i + 6 < heights.size(); ++i) fastest = std::max(fastest, slope(Curve(heights.begin() + i, heights.begin() + i + 7)));
  outcome.figures.push_back(relativeFigure("largest rise speed", fastest, kLargestRise));
  outcome.figures.push_back(relativeFigure("height after 3 s", heights.back().second, kCenterAtEnd));
  return outcome;
}

}  // namespace

std::vector<Experiment> bubbleExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"rising-bubble", level, false, kRiseSpacing[level], [level](const Bench& bench) { return risingBubble(bench, level); }});
  return all;
}

}  // namespace rill::bench
