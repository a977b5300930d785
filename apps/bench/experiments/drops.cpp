// Surface tension: a drop that oscillates, drops on a plate, liquid that rises between plates, and a jet that breaks up.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/drop_theory.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"
#include "core/disjoint_sets.hpp"

namespace rill::bench {
namespace {

constexpr double kTension = 0.072, kDensity = 1000, kWaterDropRadius = 0.001;  // N/m, kg/m^3, m: water
constexpr int kWaterDropResolution[kLevels] = {5, 7, 10};                      // spacings a radius

Scene weightlessWater(double spacing) { return weightless(spacing, kDensity, kTension); }
double waterDropPeriod(double radius) { return dropPeriod(2, radius, kDensity, kTension); }

/// How much longer along x than across, from second moments: about 1.5 times the amplitude of mode 2 over the radius.
double elongation(const Cloud& cloud) {
  const Double3 middle = meanPosition(cloud);
  double along = 0, across = 0;
  for (const Double3& p : cloud.position) {
    along += std::pow(p.x - middle.x, 2);
    across += (std::pow(p.y - middle.y, 2) + std::pow(p.z - middle.z, 2)) / 2;
  }
  return std::sqrt(along / across) - 1;
}

// A ball of the rest lattice becomes a drop for two periods, with drag. Then it gets the velocities of mode 2.
Expected<Outcome> oscillatingDrop(const Bench& bench, unsigned level) {
  const double spacing = kWaterDropRadius / kWaterDropResolution[level], period = waterDropPeriod(kWaterDropRadius), frame = period / 60;
  Scene ball = weightlessWater(spacing);
  ball.fluid.drag = 4 / period;
  ball.fill.push_back({.shape = SphereShape{{0, 0, 0}, kWaterDropRadius}});
  ball.probes.push_back({.name = "middle", .pressure = Double3{0, 0, 0}});
  auto before = settle(bench, ball, 2 * period, frame);
  if (!before) return before.error();
  Cloud settledDrop = std::move(before->cloud);
  Outcome outcome;
  if (bench.stopped()) return outcome;
  double pressure = 0, count = 0;
  for (const apps::Instant& instant : before->run.instants) {
    if (instant.time_s < period) continue;
    pressure += std::get<offline::PressureValue>(instant.stats.probes[0].second).pressure;
    ++count;
  }
  const double radius = radiusOf(settledDrop), rate = 2 * std::numbers::pi / waterDropPeriod(radius);
  constexpr double kAmplitude = 0.15;  // of the radius
  const Double3 middle = meanPosition(settledDrop);
  settledDrop.velocity.assign(settledDrop.size(), {});
  for (size_t i = 0; i < settledDrop.size(); ++i) {
    const Double3& p = settledDrop.position[i];
    const double s = kAmplitude * rate;
    settledDrop.velocity[i] = {s * (p.x - middle.x), -s / 2 * (p.y - middle.y), -s / 2 * (p.z - middle.z)};
  }
  const auto start = StartFile::write(settledDrop);
  if (!start) return start.error();
  Scene scene = weightlessWater(spacing);
  scene.fill.push_back(start->fill());
  Curve elongations;
  double drift = 0;
  auto run = runSampled(
      bench, scene, 2.2 * waterDropPeriod(radius), frame, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        elongations.emplace_back(time, elongation(cloud));
        const Double3 now = meanPosition(cloud);
        drift = std::max(std::hypot(now.x - middle.x, now.y - middle.y, now.z - middle.z) / radius, drift);
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  outcome.curves["elongation"] = curveJson(elongations);
  const Oscillation found = oscillation(elongations, waterDropPeriod(radius) / 8, 0.1);
  outcome.figures.push_back(relativeFigure("period", found.period, waterDropPeriod(radius)));
  outcome.figures.push_back(plainFigure("damping a period", found.decrement));
  outcome.figures.push_back(relativeFigure("pressure", pressure / count, 2 * kTension / radius));
  outcome.figures.push_back(plainFigure("drift of the center", drift));
  return outcome;
}

/// The contact angle of a cap of a ball, degrees, by its volume and the height of its center of mass.
double capAngle(double volume, double height) {
  double low = 1, high = 179;
  for (int step = 0; step < 50; ++step) {
    const double angle = (low + high) / 2 * std::numbers::pi / 180, c = std::cos(angle);
    const double radius = std::cbrt(volume / (std::numbers::pi / 3 * (2 + c) * (1 - c) * (1 - c)));
    const double tall = radius * (1 - c);
    constexpr int kSlices = 400;
    double moment = 0;
    for (int k = 0; k < kSlices; ++k) {
      const double y = (k + 0.5) / kSlices * tall, above = y + radius * c;
      moment += y * std::numbers::pi * std::max(radius * radius - above * above, 0.0) * tall / kSlices;
    }
    (moment / volume < height ? low : high) = (low + high) / 2;
  }
  return low;
}

// The half of a ball above a plate becomes a drop with the contact angle.
Expected<Outcome> sessile(const Bench& bench, unsigned level, double angle) {
  const double spacing = kWaterDropRadius / kWaterDropResolution[level], end = 4 * waterDropPeriod(kWaterDropRadius),
               wide = 3 * kWaterDropRadius;
  Scene scene = weightlessWater(spacing);
  scene.fluid.contact_angle = angle;
  scene.fluid.drag = 2 / waterDropPeriod(kWaterDropRadius);
  scene.domain = Domain{.min = {-wide, 0, -wide}, .max = {wide, wide, wide}, .open = 0b111011};
  scene.fill.push_back({.shape = SphereShape{{0, 0, 0}, kWaterDropRadius}});
  double found = std::numeric_limits<double>::quiet_NaN();
  auto run = runSampled(
      bench, scene, end, end / 200, [&](double time) { return time > end * 0.9975; },
      [&](const Cloud& cloud, double) { found = capAngle(double(cloud.size()) * std::pow(spacing, 3), meanPosition(cloud).y); });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  outcome.figures.push_back({"contact angle", found, angle, found - angle});
  return outcome;
}

// Two plates in a tank: between plates `gap` apart liquid rises by 2 sigma cos(angle) / (density g gap) (Jurin 1718, for plates), and
// between the plates and the walls of the tank as well.
constexpr double kRiseGap = 0.006, kRiseAngle = 30;  // m, degrees
constexpr int kRiseResolution[kLevels] = {5, 7, 9};  // spacings a gap
Expected<Outcome> rise(const Bench& bench, unsigned level) {
  const double spacing = kRiseGap / kRiseResolution[level], thick = 3 * spacing, depth = 2 * kRiseGap, wide = 8 * spacing;
  const double length = 9 * kRiseGap, tension = 0.15, beside = (length - kRiseGap) / 2 - thick;
  const double expected = 2 * tension * std::cos(kRiseAngle * std::numbers::pi / 180) / (kDensity * 9.81) * (1 / kRiseGap - 1 / beside);
  Scene scene = boxScene(spacing, {0, 0, 0}, {length, 5 * kRiseGap, wide});
  scene.fluid.surface_tension = tension;
  scene.fluid.contact_angle = kRiseAngle;
  scene.domain->open = 0b001000;
  const double from = (length - kRiseGap) / 2, to = from + kRiseGap, low = kRiseGap, top = 5 * kRiseGap;
  scene.solids.push_back({.shape = BoxShape{{from - thick, low, -wide}, {from, top, 2 * wide}}});
  scene.solids.push_back({.shape = BoxShape{{to, low, -wide}, {to + thick, top, 2 * wide}}});
  scene.fill = {boxFill({0, 0, 0}, {length, depth, wide})};
  Curve heights;
  double between = 0, outside = 0, count = 0;
  constexpr double kEnd = 1.5;
  auto run = runSampled(
      bench, scene, kEnd, 1.0 / 120, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        // By volume: what stands between the plates, above their lower edges, and what stands outside.
        double in = 0, out = 0;
        for (const Double3& p : cloud.position) {
          if (p.y < low) continue;
          if (p.x > from && p.x < to) ++in;
          if (p.x < from - thick || p.x > to + thick) ++out;
        }
        const double volume = std::pow(spacing, 3);
        const double high = in * volume / (kRiseGap * wide), around = out * volume / ((length - kRiseGap - 2 * thick) * wide);
        heights.emplace_back(time, high - around);
        if (time < 0.8 * kEnd) return;
        between += high, outside += around, ++count;
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  outcome.curves["rise"] = curveJson(heights);
  outcome.figures.push_back(relativeFigure("rise", (between - outside) / count, expected));
  return outcome;
}

/// The drops that a thread became.
struct ThreadDrops {
  double radii = 0;  ///< sum, m
  double count = 0;  ///< one at a wall is half of one
};
ThreadDrops threadDrops(const Cloud& cloud, double wall, double leastParticles) {
  const double reach = 1.6 * cloud.spacing;
  DisjointSets sets(cloud.size());
  const NeighborGrid grid(cloud.position, reach);
  for (size_t i = 0; i < cloud.size(); ++i)
    grid.within(cloud.position[i], reach, [&](size_t j, double) { sets.join(static_cast<uint32_t>(i), static_cast<uint32_t>(j)); });
  struct Drop {
    size_t particles = 0;
    bool atWall = false;
  };
  std::unordered_map<size_t, Drop> found;
  for (size_t i = 0; i < cloud.size(); ++i) {
    Drop& drop = found[sets.root(static_cast<uint32_t>(i))];
    ++drop.particles;
    drop.atWall |= std::abs(cloud.position[i].x) > wall - cloud.spacing;
  }
  ThreadDrops all;
  for (const auto& [root, drop] : found) {
    const double share = drop.atWall ? 0.5 : 1, whole = double(drop.particles) / share;
    if (whole < leastParticles) continue;
    all.radii += share * cloud.spacing * std::cbrt(0.75 * whole / std::numbers::pi);
    all.count += share;
  }
  return all;
}

// A thread that mirror images continue at both walls breaks up into drops as far apart as the fastest wave is long, 9.02 radii
// (Rayleigh 1878): drops of 1.89 radii. Half a drop may stay at a wall.
constexpr double kThreadRadius = 0.001;
constexpr int kThreadResolution[kLevels] = {2, 3, 4};  // spacings a radius
Expected<Outcome> thread(const Bench& bench, unsigned level) {
  const double spacing = kThreadRadius / kThreadResolution[level], wave = 9.02 * kThreadRadius, half = 3 * wave;
  Cloud cloud{.position = {}, .velocity = {}, .spacing = spacing};
  const int across = kThreadResolution[level] + 1, along = static_cast<int>(half / spacing);
  const double wall = along * spacing;
  // Waves of all lengths from twice the thread's to a quarter of the fastest's, equally fast, of either sign.
  const auto noise = [&](double x) {
    constexpr int kWaves = 48;
    constexpr uint64_t kSigns = 0x9E3779B97F4A;
    double speed = 0;
    for (int m = 1; m <= kWaves; ++m) speed += (kSigns >> (m - 1) & 1 ? 1 : -1) * std::sin(m * std::numbers::pi * (x + wall) / (2 * wall));
    return 0.05 * std::sqrt(kTension / (kDensity * kThreadRadius)) * speed;
  };
  for (int i = -along; i < along; ++i)
    for (int j = -across; j < across; ++j)
      for (int k = -across; k < across; ++k) {
        const Double3 p{(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing};
        if (std::hypot(p.y, p.z) > kThreadRadius) continue;
        cloud.position.push_back(p);
        cloud.velocity.push_back({noise(p.x), 0, 0});
      }
  const auto start = StartFile::write(cloud);
  if (!start) return start.error();
  Scene scene = weightlessWater(spacing);
  const double room = 6 * kThreadRadius;
  scene.domain = Domain{{-wall, -room, -room}, {wall, room, room}, SideMask{0b111100}};
  scene.fill.push_back(start->fill());
  const double unit = std::sqrt(kDensity * std::pow(kThreadRadius, 3) / kTension), end = 25 * unit;
  const double particlesOfWave = std::numbers::pi * kThreadRadius * kThreadRadius * wave / std::pow(spacing, 3);
  ThreadDrops most;  // before drops that touch become one
  Curve counts;
  auto run = runSampled(
      bench, scene, end, end / 100, [](double) { return true; },
      [&](const Cloud& sample, double time) {
        const ThreadDrops now = threadDrops(sample, wall, particlesOfWave / 5);  // no smaller ones, which are between two drops
        if (now.count > most.count) most = now;
        counts.emplace_back(time / unit, now.count);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  outcome.curves["drops"] = curveJson(counts);
  outcome.figures.push_back(relativeFigure("mean radius of drops", most.radii / most.count / kThreadRadius, std::cbrt(0.75 * 9.02)));
  outcome.figures.push_back(relativeFigure("distance of drops", 2 * wall / most.count / kThreadRadius, 9.02));
  return outcome;
}

}  // namespace

std::vector<Experiment> dropExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double spacing = kWaterDropRadius / kWaterDropResolution[level];
    all.push_back({"drop", level, level == 0, spacing, [level](const Bench& bench) { return oscillatingDrop(bench, level); }});
    for (const int angle : {30, 60, 90, 120, 150})
      all.push_back({"sessile-drop-" + std::to_string(angle), level, level == 0 && angle == 60, spacing,
                     [level, angle](const Bench& bench) { return sessile(bench, level, angle); }});
    all.push_back(
        {"capillary-rise", level, false, kRiseGap / kRiseResolution[level], [level](const Bench& bench) { return rise(bench, level); }});
    all.push_back(
        {"thread", level, false, kThreadRadius / kThreadResolution[level], [level](const Bench& bench) { return thread(bench, level); }});
  }
  return all;
}

}  // namespace rill::bench
