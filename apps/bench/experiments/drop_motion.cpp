// Surface tension: what drops keep of their spin and energy, mode 3 of a drop, and capillary waves.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/drop_theory.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"
#include "reference/solver.hpp"

namespace rill::bench {
namespace {

constexpr double kUnitTension = 1, kUnitDensity = 1000, kUnitSpacing = 0.01;  // N/m, kg/m^3, m

Scene weightlessUnit() { return weightless(kUnitSpacing, kUnitDensity, kUnitTension); }
double unitDropPeriod(int n, double radius) { return dropPeriod(n, radius, kUnitDensity, kUnitTension); }

/// Points of a cubic lattice around the origin.
Cloud latticeWhere(int half, const std::function<bool(const Double3&)>& inside) {
  Cloud cloud{.position = {}, .velocity = {}, .spacing = kUnitSpacing};
  for (int i = -half; i < half; ++i)
    for (int j = -half; j < half; ++j)
      for (int k = -half; k < half; ++k)
        if (const Double3 p{(i + 0.5) * kUnitSpacing, (j + 0.5) * kUnitSpacing, (k + 0.5) * kUnitSpacing}; inside(p))
          cloud.position.push_back(p);
  cloud.velocity.assign(cloud.size(), {});
  return cloud;
}

/// NaN without as many.
double crossing(const std::vector<double>& crossings, size_t k) {
  return k < crossings.size() ? crossings[k] : std::numeric_limits<double>::quiet_NaN();
}

double norm(const Double3& v) { return std::hypot(v.x, v.y, v.z); }

// A ball that spins as one.
constexpr double kBall[kLevels] = {5.5, 7, 9};  // spacings
Expected<Outcome> spinningDrop(const Bench& bench, unsigned level, double viscosity) {
  const double radius = kBall[level] * kUnitSpacing, spin = 2;
  Cloud ball = latticeWhere(12, [&](const Double3& p) { return norm(p) < radius; });
  for (size_t i = 0; i < ball.size(); ++i) ball.velocity[i] = {-spin * ball.position[i].y, spin * ball.position[i].x, 0};
  const auto start = StartFile::write(ball);
  if (!start) return start.error();
  Scene scene = weightlessUnit();
  scene.fluid.viscosity = viscosity;
  scene.fill.push_back(start->fill());
  Curve spins;
  double drift = 0, first = 0;
  auto run = runSampled(
      bench, scene, 2, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const double now = meanAngularMomentum(cloud).z;
        if (time == 0) first = now;
        spins.emplace_back(time, now / first);
        drift = std::max(drift, norm(meanPosition(cloud)) / radius);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  outcome.curves["spin"] = curveJson(spins);
  outcome.figures.push_back(relativeFigure("angular momentum after 1 s", at(spins, 1), 1));
  outcome.figures.push_back(relativeFigure("angular momentum after 2 s", at(spins, 2), 1));
  outcome.figures.push_back(relativeFigure("angular momentum, last second", at(spins, 2) / at(spins, 1), 1));
  outcome.figures.push_back(plainFigure("drift of the center", drift));
  return outcome;
}

/// Kinetic energy and that of the surface, J.
struct DropEnergy {
  double kinetic = 0, surface = 0;
};
DropEnergy energyOf(const Cloud& cloud) {
  reference::ReferenceSettings settings;
  settings.spacing = kUnitSpacing;
  settings.surfaceTension = kUnitTension;
  std::vector<glm::dvec3> positions;
  DropEnergy energy;
  for (size_t i = 0; i < cloud.size(); ++i) {
    positions.emplace_back(cloud.position[i].x, cloud.position[i].y, cloud.position[i].z);
    energy.kinetic += 0.5 * kUnitDensity * std::pow(kUnitSpacing, 3) * std::pow(norm(cloud.velocity[i]), 2);
  }
  energy.surface = reference::ReferenceSolver(settings, positions).surfaceEnergy();
  return energy;
}

constexpr double kLatticeMelts = 0.1;  // s
// A cube that becomes a drop and comes to rest.
constexpr int kCube[kLevels] = {4, 6, 8};  // spacings, half an edge
Expected<Outcome> cube(const Bench& bench, unsigned level) {
  const auto start = StartFile::write(latticeWhere(kCube[level], [](const Double3&) { return true; }));
  if (!start) return start.error();
  Scene scene = weightlessUnit();
  scene.fill.push_back(start->fill());
  Curve energies;
  double drift = 0, first = 0, gain = 0, least = 0, spin = 0, rest = 0, restCount = 0;
  auto run = runSampled(
      bench, scene, 4, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const DropEnergy energy = energyOf(cloud);
        const double all = energy.kinetic + energy.surface, radius = radiusOf(cloud), area = 4 * std::numbers::pi * radius * radius;
        if (time == 0) first = all;
        if (time > kLatticeMelts) least = least == 0 ? all : std::min(least, all), gain = std::max(gain, (all - least) / first);
        energies.emplace_back(time, all / first);
        drift = std::max(drift, norm(meanPosition(cloud)) / radius);
        spin = std::max(spin, norm(meanAngularMomentum(cloud)));
        if (time > 3) rest += energy.kinetic / (kUnitTension * area), ++restCount;
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  outcome.curves["energy"] = curveJson(energies);
  outcome.figures.push_back(plainFigure("energy, gain", gain));
  outcome.figures.push_back(plainFigure("energy, end", energies.back().second));
  outcome.figures.push_back(plainFigure("kinetic energy at rest", rest / restCount));
  outcome.figures.push_back(plainFigure("angular momentum", spin));
  outcome.figures.push_back(plainFigure("drift of the center", drift));
  return outcome;
}

// Mode 3 of a drop that has come to rest with drag.
constexpr double kModeBall[kLevels] = {6, 7.5, 9};
Expected<Outcome> modeThree(const Bench& bench, unsigned level) {
  const double size = kModeBall[level] * kUnitSpacing;
  Scene ball = weightlessUnit();
  ball.fluid.drag = 4 / unitDropPeriod(2, size);
  const auto ballStart = StartFile::write(latticeWhere(12, [&](const Double3& p) { return norm(p) < size; }));
  if (!ballStart) return ballStart.error();
  ball.fill.push_back(ballStart->fill());
  const double frame = unitDropPeriod(3, size) / 60;
  auto before = settle(bench, ball, 2 * unitDropPeriod(2, size), frame);
  if (!before) return before.error();
  Cloud drop = std::move(before->cloud);
  Outcome outcome;
  if (bench.stopped()) return outcome;
  const double radius = radiusOf(drop), period = unitDropPeriod(3, radius);
  const Double3 middle = meanPosition(drop);
  drop.velocity.assign(drop.size(), {});
  for (size_t i = 0; i < drop.size(); ++i) {
    const double x = drop.position[i].x - middle.x, y = drop.position[i].y - middle.y, z = drop.position[i].z - middle.z;
    const double s = 0.12 * 2 * std::numbers::pi / period / (3 * radius);
    drop.velocity[i] = {s * (3 * x * x - 1.5 * (y * y + z * z)), -3 * s * x * y, -3 * s * x * z};
  }
  const auto start = StartFile::write(drop);
  if (!start) return start.error();
  Scene scene = weightlessUnit();
  scene.fill.push_back(start->fill());
  Curve curve;
  auto run = runSampled(
      bench, scene, 2.2 * period, frame, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const Double3 c = meanPosition(cloud);
        double sum = 0;
        for (const Double3& p : cloud.position) {
          const double x = p.x - c.x, y = p.y - c.y, z = p.z - c.z;
          sum += x * x * x - 1.5 * x * (y * y + z * z);
        }
        curve.emplace_back(time, sum / double(cloud.size()) / std::pow(radius, 3));
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  outcome.curves["mode"] = curveJson(curve);
  const auto crossings = zeroCrossings(curve, curve.front().second, period / 8);
  for (size_t k = 0; k < 3; ++k)
    outcome.figures.push_back(relativeFigure("half period " + std::to_string(k + 1),
                                             crossing(crossings, k) - (k == 0 ? 0 : crossing(crossings, k - 1)), period / 2));
  return outcome;
}

// A wave in a tank one wave long, from rest.
constexpr int kWaveLength[kLevels] = {16, 24, 32};
Expected<Outcome> capillaryWave(const Bench& bench, unsigned level) {
  const int n = kWaveLength[level], deep = n / 2, wide = 6;
  const double d = kUnitSpacing, length = n * d, k = 2 * std::numbers::pi / length, depth = deep * d, amplitude = length / 25;
  const double period = 2 * std::numbers::pi / std::sqrt(kUnitTension * k * k * k / kUnitDensity * std::tanh(k * depth));
  Cloud cloud{.position = {}, .velocity = {}, .spacing = d};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < deep; ++j)
      for (int l = 0; l < wide; ++l) {
        const double x = (i + 0.5) * d, y = (j + 0.5) * d, s = amplitude / std::sinh(k * depth);
        cloud.position.push_back({x - s * std::sin(k * x) * std::cosh(k * y), y + s * std::cos(k * x) * std::sinh(k * y), (l + 0.5) * d});
      }
  cloud.velocity.assign(cloud.size(), {});
  const auto start = StartFile::write(cloud);
  if (!start) return start.error();
  Scene scene = weightlessUnit();
  scene.domain = Domain{.min = {0, 0, 0}, .max = {length, 4 * depth, wide * d}, .open = 0b001000};
  scene.fill.push_back(start->fill());
  Curve curve;
  auto run = runSampled(
      bench, scene, 1.2 * period, period / 100, [](double) { return true; },
      [&](const Cloud& sample, double time) {
        double sum = 0;
        for (const Double3& p : sample.position) sum += p.y * std::cos(k * p.x);
        curve.emplace_back(time, sum / double(sample.size()) / d);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  outcome.curves["wave"] = curveJson(curve);
  const auto crossings = zeroCrossings(curve, 0, 0);
  for (size_t m = 0; m < 2; ++m)
    outcome.figures.push_back(relativeFigure("zero " + std::to_string(m + 1), crossing(crossings, m), period * (0.25 + 0.5 * double(m))));
  return outcome;
}

}  // namespace

std::vector<Experiment> dropMotionExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    all.push_back({"spinning-drop", level, false, 1 / kBall[level], [level](const Bench& b) { return spinningDrop(b, level, 5); }});
    all.push_back({"thin-spinning-drop", level, false, 1 / kBall[level], [level](const Bench& b) { return spinningDrop(b, level, 0.05); }});
    all.push_back({"cube-to-drop", level, false, 1.0 / kCube[level], [level](const Bench& b) { return cube(b, level); }});
    all.push_back({"drop-mode-3", level, false, 1 / kModeBall[level], [level](const Bench& b) { return modeThree(b, level); }});
    all.push_back({"capillary-wave", level, false, 1.0 / kWaveLength[level], [level](const Bench& b) { return capillaryWave(b, level); }});
  }
  return all;
}

}  // namespace rill::bench
