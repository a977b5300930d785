// A weightless disc that deforms into an ellipse, as a slab between frictionless walls.
#include <cmath>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/exact.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"

namespace rill::bench {
namespace {

constexpr double kDropRadius = 1;                       // m
constexpr double kRate = 1;                             // A0, 1/s
constexpr int kDropResolution[kLevels] = {10, 16, 24};  // spacings per radius
constexpr int kDropThickness = 4;

Cloud disc(double spacing) {
  Cloud cloud;
  cloud.spacing = spacing;
  const int half = static_cast<int>(std::ceil(kDropRadius / spacing));
  for (int i = -half; i < half; ++i)
    for (int j = -half; j < half; ++j)
      for (int l = 0; l < kDropThickness; ++l) {
        const double x = (i + 0.5) * spacing, y = (j + 0.5) * spacing;
        if (x * x + y * y > kDropRadius * kDropRadius) continue;
        cloud.position.push_back({x, y, (l + 0.5) * spacing});
        cloud.velocity.push_back({-kRate * x, kRate * y, 0});
      }
  return cloud;
}

/// Semi-axes of the ellipse with the same second moments.
std::pair<double, double> semiAxes(const Cloud& cloud) {
  const Double3 center = meanPosition(cloud);
  double xx = 0, yy = 0;
  for (const Double3& point : cloud.position) {
    xx += (point[0] - center[0]) * (point[0] - center[0]);
    yy += (point[1] - center[1]) * (point[1] - center[1]);
  }
  const double n = double(cloud.size());
  return {2 * std::sqrt(xx / n), 2 * std::sqrt(yy / n)};
}

Expected<Outcome> drop(const Bench& bench, unsigned level) {
  const double spacing = kDropRadius / kDropResolution[level];
  const auto points = publishedCurve("elliptic_drop");
  if (!points) return points.error();
  const auto start = StartFile::write(disc(spacing));
  if (!start) return start.error();
  Scene scene = boxScene(spacing, {-5, -5, 0}, {5, 5, kDropThickness * spacing});
  scene.gravity[1] = 0;
  scene.fill.push_back(start->fill());
  Curve longAxis, shortAxis;
  double radius = 0;
  auto run = runSampled(
      bench, scene, 2 / kRate, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const auto [a, b] = semiAxes(cloud);
        if (time == 0) radius = std::sqrt(a * b);  // of the discretized disc
        shortAxis.emplace_back(kRate * time, a / radius);
        longAxis.emplace_back(kRate * time, b / radius);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  double worst = 0;
  for (const auto& [time, axis] : *points)
    if (const double error = at(longAxis, time) / axis - 1; std::abs(error) > std::abs(worst)) worst = error;
  const EllipticDrop exact = ellipticDrop(2);
  outcome.figures.push_back(relativeFigure("long axis, end", longAxis.back().second, exact.b));
  outcome.figures.push_back(plainFigure("long axis, worst", worst));
  outcome.figures.push_back(relativeFigure("short axis, end", shortAxis.back().second, exact.a));
  outcome.figures.push_back(relativeFigure("area, end", shortAxis.back().second * longAxis.back().second, 1));
  outcome.figures.push_back(plainFigure("energy, peak", outcome.run.energy.ratio - 1));
  outcome.curves["long_axis"] = curveJson(longAxis);
  outcome.curves["short_axis"] = curveJson(shortAxis);
  outcome.overlays.push_back({"elliptic", {"R / d = " + std::to_string(kDropResolution[level]), Series::Style::Lines, longAxis, {}}});
  return outcome;
}

}  // namespace

std::vector<Experiment> ellipticExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"elliptic-drop", level, level < 2, kDropRadius / kDropResolution[level],
                   [level](const Bench& bench) { return drop(bench, level); }});
  return all;
}

}  // namespace rill::bench
