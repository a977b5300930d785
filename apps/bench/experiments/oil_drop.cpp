// Tension between liquids: a drop of oil in a box of water.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"

namespace rill::bench {
namespace {

constexpr double kOilTension = 0.02, kOilAir = 0.03, kWaterAir = 0.072;  // N/m: between them, and of each against air
constexpr double kOil = 900, kWater = 1000;                              // kg/m^3
constexpr double kOilRadius = 0.001, kOilRoom = 3.6;                     // m, and the width of the box over it
constexpr int kOilResolution[] = {5, 7};                                 // spacings a radius

// Period of mode 2 of a drop in another liquid (Lamb 1932, section 275).
double oilPeriod(double radius) {
  return 2 * std::numbers::pi * std::sqrt((3 * kOil + 2 * kWater) * std::pow(radius, 3) / (24 * kOilTension));
}

/// The drop, then the water around it, both without gravity; the side +y of the box is open.
struct OilAndWater {
  Cloud oil, water;
};

Double3 middleOf(const Cloud& cloud, size_t count) {
  Double3 sum{0, 0, 0};
  for (size_t i = 0; i < count; ++i)
    for (int a = 0; a < 3; ++a) sum[a] += cloud.position[i][a] / double(count);
  return sum;
}

double oilElongation(const Cloud& cloud, size_t count, const Double3& middle) {
  double along = 0, across = 0;
  for (size_t i = 0; i < count; ++i) {
    const Double3& p = cloud.position[i];
    along += std::pow(p.x - middle.x, 2);
    across += (std::pow(p.y - middle.y, 2) + std::pow(p.z - middle.z, 2)) / 2;
  }
  return std::sqrt(along / across) - 1;
}

OilAndWater ballInBox(double spacing, int cells) {
  OilAndWater both{.oil = {.spacing = spacing}, .water = {.spacing = spacing}};
  const double half = 0.5 * cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const Double3 p{(i + 0.5 - half) * spacing, (j + 0.5 - half) * spacing, (k + 0.5 - half) * spacing};
        Cloud& cloud = std::hypot(p.x, p.y, p.z) < kOilRadius ? both.oil : both.water;
        cloud.position.push_back(p);
        cloud.velocity.push_back({});
      }
  return both;
}

/// Velocities of mode 2 in a drop of `radius` and around it, of `rate` (1/s) inside.
Double3 modeTwo(const Double3& q, double radius, double rate) {
  const double l = std::hypot(q.x, q.y, q.z);
  if (l <= radius) return {rate * q.x, -rate / 2 * q.y, -rate / 2 * q.z};
  // The gradient of  -rate r^5 / 6 (2 x^2 - y^2 - z^2) / l^5,  whose part along q is that of the drop at its surface.
  const double unit = -rate * std::pow(radius, 5) / 6 / std::pow(l, 5), form = 5 * (2 * q.x * q.x - q.y * q.y - q.z * q.z) / (l * l);
  return {unit * (4 - form) * q.x, unit * (-2 - form) * q.y, unit * (-2 - form) * q.z};
}

Expected<Outcome> oilDrop(const Bench& bench, unsigned level) {
  const double spacing = kOilRadius / kOilResolution[level], period = oilPeriod(kOilRadius), frame = period / 60;
  const int cells = 2 * static_cast<int>(kOilRoom / 2 * kOilResolution[level]);
  const double half = 0.5 * cells * spacing;
  OilAndWater both = ballInBox(spacing, cells);
  const size_t count = both.oil.size();
  Scene scene = boxScene(spacing, {-half, -half, -half}, {half, 1.5 * half, half});
  scene.gravity = {0, 0, 0};
  scene.domain->open = 0b001000;
  scene.fluids = {{.name = "oil", .density = kOil, .surface_tension = kOilAir},
                  {.name = "water", .density = kWater, .surface_tension = kWaterAir}};
  scene.interfaces = {{.between = {"oil", "water"}, .tension = kOilTension}};
  const auto filled = [&](const StartFile& oil, const StartFile& water, double jitter) {
    Scene all = scene;
    all.fill = {oil.fill(), water.fill()};
    all.fill[0].fluid = "oil", all.fill[1].fluid = "water";
    for (Fill& fill : all.fill) fill.jitter = jitter;
    return all;
  };
  const auto oil = StartFile::write(both.oil), water = StartFile::write(both.water);
  if (!oil) return oil.error();
  if (!water) return water.error();
  Scene settling = filled(*oil, *water, 0.1);
  settling.fluid.drag = 4 / period;
  const double outside = 0.75 * half;
  settling.probes = {{.name = "in", .pressure = Double3{0, 0, 0}}, {.name = "out", .pressure = Double3{outside, outside, outside}}};
  const auto before = settle(bench, settling, 2 * period, frame);
  if (!before) return before.error();
  const Cloud& settled = before->cloud;
  Outcome outcome;
  if (bench.stopped()) return outcome;
  double pressure = 0, instants = 0;
  for (const apps::Instant& instant : before->run.instants) {
    if (instant.time_s < period) continue;
    const auto at = [&](size_t probe) { return std::get<offline::PressureValue>(instant.stats.probes[probe].second).pressure; };
    pressure += at(0) - at(1);
    ++instants;
  }
  const double radius = spacing * std::cbrt(0.75 * double(count) / std::numbers::pi), lamb = oilPeriod(radius);
  constexpr double kAmplitude = 0.15;  // of the radius
  const Double3 middle = middleOf(settled, count);
  Cloud drop{.spacing = spacing}, around{.spacing = spacing};
  for (size_t i = 0; i < settled.size(); ++i) {
    const Double3& p = settled.position[i];
    Cloud& cloud = i < count ? drop : around;
    cloud.position.push_back(p);
    cloud.velocity.push_back(modeTwo({p.x - middle.x, p.y - middle.y, p.z - middle.z}, radius, kAmplitude * 2 * std::numbers::pi / lamb));
  }
  const auto dropStart = StartFile::write(drop), aroundStart = StartFile::write(around);
  if (!dropStart) return dropStart.error();
  if (!aroundStart) return aroundStart.error();
  Curve elongations;
  double drift = 0;
  auto run = runSampled(
      bench, filled(*dropStart, *aroundStart, 0), 2.2 * lamb, frame, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const Double3 now = middleOf(cloud, count);
        elongations.emplace_back(time, oilElongation(cloud, count, now));
        drift = std::max(std::hypot(now.x - middle.x, now.y - middle.y, now.z - middle.z) / radius, drift);
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  outcome.curves["elongation"] = curveJson(elongations);
  const Oscillation found = oscillation(elongations, lamb / 8, 0.1);
  outcome.figures.push_back(relativeFigure("period", found.period, lamb));
  outcome.figures.push_back(plainFigure("damping a period", found.decrement));
  outcome.figures.push_back(relativeFigure("pressure", pressure / instants, 2 * kOilTension / radius));
  outcome.figures.push_back(plainFigure("drift of the center", drift));
  return outcome;
}

}  // namespace

std::vector<Experiment> oilDropExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < std::size(kOilResolution); ++level)
    all.push_back(
        {"oil-drop", level, false, kOilRadius / kOilResolution[level], [level](const Bench& bench) { return oilDrop(bench, level); }});
  return all;
}

}  // namespace rill::bench
