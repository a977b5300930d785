// Surface tension on solids: a drop and a free body, a drop on a held plate, and a bridge between two held plates.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "bench/experiments/drop_theory.hpp"
#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

constexpr double kWetTension = 0.072, kWetDensity = 1000, kWetRadius = 0.001;  // N/m, kg/m^3, m: water
constexpr int kWetResolution[kLevels] = {5, 7, 10};                            // spacings a radius

double norm(const Double3& v) { return std::hypot(v.x, v.y, v.z); }

Scene wetScene(double spacing, double angle) {
  Scene scene = weightless(spacing, kWetDensity, kWetTension);
  scene.fluid.contact_angle = angle;
  return scene;
}

// A drop that touches a face of a free box of half of its density, off the middle.
Expected<Outcome> dropAndBody(const Bench& bench, double spacing, double angle) {
  constexpr double kHalf = 0.8 * kWetRadius;
  Scene scene = wetScene(spacing, angle);
  scene.fill.push_back({.shape = SphereShape{{0, 0, 0}, kWetRadius}});
  scene.solids.push_back({.shape = BoxShape{{-kHalf, -0.9 * kWetRadius - kHalf, -kHalf / 2}, {kHalf, -0.9 * kWetRadius, kHalf}},
                          .body = Body{.density = kWetDensity / 2},
                          .name = "body"});
  const double end = 3 * dropPeriod(2, kWetRadius, kWetDensity, kWetTension);
  auto run = runScene(bench, {.scene = scene, .duration_s = end, .frame_s = end / 180});
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  double off = 0, largest = 0;
  std::vector<std::pair<double, double>> curve;
  for (const apps::Instant& instant : outcome.run.instants) {
    const Double3 &fluid = instant.stats.momentum, &body = instant.stats.bodies->momentum;
    largest = std::max({largest, norm(fluid), norm(body)});
    off = std::max(off, norm({fluid.x + body.x, fluid.y + body.y, fluid.z + body.z}));
    curve.emplace_back(instant.time_s, body.y);
  }
  outcome.figures.push_back(plainFigure("momentum of all", off / largest));
  outcome.curves["momentum of the body, kg m/s"] = curveJson(curve);
  return outcome;
}

/// Mean of a component of a load's force over the last half of a run, N.
double meanForce(const RunFigures& run, size_t probe, size_t axis) {
  double sum = 0, count = 0;
  for (const apps::Instant& instant : run.instants) {
    if (instant.time_s < 0.5 * run.instants.back().time_s) continue;
    sum += std::get<offline::LoadValue>(instant.stats.probes[probe].second).force[axis];
    ++count;
  }
  return sum / count;
}

Expected<RunFigures> runAtRest(const Bench& bench, Scene scene) {
  const double period = dropPeriod(2, kWetRadius, kWetDensity, kWetTension), end = 4 * period;
  scene.fluid.drag = 4 / period;
  return runScene(bench, {.scene = std::move(scene), .duration_s = end, .frame_s = end / 200});
}

// Half of a ball becomes a drop on a plate. Its pressure pushes the plate by 2 pi r sigma sin(angle), r the radius of its foot; its rim
// pulls the plate by as much.
Expected<Outcome> dropOnPlate(const Bench& bench, double spacing, double angle) {
  constexpr double kWide = 3 * kWetRadius;
  Scene scene = wetScene(spacing, angle);
  scene.domain = Domain{.min = {-kWide, 0, -kWide}, .max = {kWide, kWide, kWide}, .open = 0b111111};
  scene.fill.push_back({.shape = SphereShape{{0, 0, 0}, kWetRadius}});
  scene.solids.push_back({.shape = BoxShape{{-kWide, -4 * spacing, -kWide}, {kWide, 0, kWide}}, .name = "plate"});
  scene.probes.push_back({.name = "load", .load = "plate"});
  auto run = runAtRest(bench, scene);
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
  const double foot = s * kWetRadius * std::cbrt(2 / ((2 + c) * (1 - c) * (1 - c)));  // of a cap as large as the half of the ball
  outcome.figures.push_back(
      plainFigure("load over the rim's pull", meanForce(outcome.run, 0, 1) / (2 * std::numbers::pi * foot * kWetTension * s)));
  return outcome;
}

// A cylinder between two plates, which it meets at 90 degrees: its pressure pushes them apart by pi a^2 sigma / a, its rim pulls each by
// 2 pi a sigma.
Expected<Outcome> bridge(const Bench& bench, double spacing) {
  constexpr double kGap = kWetRadius, kWide = 3 * kWetRadius;
  Scene scene = wetScene(spacing, 90);
  constexpr double kSide = kWetRadius / (2 * std::numbers::inv_sqrtpi);  // half of a square's with the area of the circle
  scene.fill.push_back(boxFill({-kSide, 0, -kSide}, {kSide, kGap, kSide}));
  scene.solids.push_back({.shape = BoxShape{{-kWide, -4 * spacing, -kWide}, {kWide, 0, kWide}}, .name = "lower"});
  scene.solids.push_back({.shape = BoxShape{{-kWide, kGap, -kWide}, {kWide, kGap + 4 * spacing, kWide}}, .name = "upper"});
  for (const char* name : {"lower", "upper"}) scene.probes.push_back({.name = name, .load = name});
  auto run = runAtRest(bench, scene);
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  const double volume = double(outcome.run.instants.front().stats.particles) * std::pow(spacing, 3);
  const double pull = std::numbers::pi * std::sqrt(volume / (std::numbers::pi * kGap)) * kWetTension;
  const double lower = meanForce(outcome.run, 0, 1), upper = meanForce(outcome.run, 1, 1);
  outcome.figures.push_back(relativeFigure("pull", (lower - upper) / 2, pull));
  outcome.figures.push_back(plainFigure("sum of both", (lower + upper) / pull));
  return outcome;
}

}  // namespace

std::vector<Experiment> wettingExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double spacing = kWetRadius / kWetResolution[level];
    const auto add = [&](const std::string& family, bool quick, auto run) {
      all.push_back({family, level, quick && level == 0, spacing, [=](const Bench& bench) { return run(bench, spacing); }});
    };
    for (const int angle : {30, 150})
      add("drop-and-body-" + std::to_string(angle), angle == 30,
          [angle](const Bench& bench, double d) { return dropAndBody(bench, d, angle); });
    for (const int angle : {60, 90, 120})
      add("drop-on-plate-" + std::to_string(angle), false, [angle](const Bench& bench, double d) { return dropOnPlate(bench, d, angle); });
    add("liquid-bridge", true, bridge);
  }
  return all;
}

}  // namespace rill::bench
