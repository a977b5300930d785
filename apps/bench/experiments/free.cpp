// Open domains: a falling block, and a drop with translation, rotation and compression.
#include <cmath>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"

namespace rill::bench {
namespace {

constexpr double kSize = 0.5;                          // m: edge of the block, radius of the drop
constexpr int kBlockResolution[kLevels] = {5, 8, 12};  // spacings per kSize
constexpr Double3 kFlight{1, 0.5, 0.25};               // m/s
constexpr double kSpin = 1, kCompression = 2;          // 1/s

double length(const Double3& vector) { return std::hypot(vector[0], vector[1], vector[2]); }
Double3 difference(const Double3& a, const Double3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Expected<Outcome> fall(const Bench& bench, unsigned level) {
  Scene scene;
  scene.fluid.spacing = kSize / kBlockResolution[level];
  scene.fill.push_back(boxFill({0, 0, 0}, {kSize, kSize, kSize}));
  constexpr double kDuration = 1;
  auto run = runScene(bench, {.scene = scene, .duration_s = kDuration, .frame_s = 1.0 / 60});
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  const auto& first = outcome.run.instants.front().stats;
  const auto& last = outcome.run.instants.back().stats;
  const double mass = double(last.particles) * scene.fluid.density * std::pow(scene.fluid.spacing, 3);
  outcome.figures.push_back(
      relativeFigure("distance", first.centerOfMass[1] - last.centerOfMass[1], -0.5 * scene.gravity[1] * kDuration * kDuration));
  outcome.figures.push_back(relativeFigure("speed", -last.momentum[1] / mass, -scene.gravity[1] * kDuration));
  return outcome;
}

/// A ball. Compression along x keeps the interior under pressure, so that particles exchange momentum; rotation alone would separate them.
/// Requires 2 kSpin^2 < 1.5 kCompression^2.
Cloud ball(double spacing) {
  Cloud cloud;
  cloud.spacing = spacing;
  const int half = kBlockResolution[kLevels - 1] + 1;
  for (int i = -half; i < half; ++i)
    for (int j = -half; j < half; ++j)
      for (int l = -half; l < half; ++l) {
        const Double3 p{(i + 0.5) * spacing, (j + 0.5) * spacing, (l + 0.5) * spacing};
        if (length(p) > kSize) continue;
        cloud.position.push_back(p);
        cloud.velocity.push_back({kFlight[0] - kCompression * p[0] - kSpin * p[1], kFlight[1] + 0.5 * kCompression * p[1] + kSpin * p[0],
                                  kFlight[2] + 0.5 * kCompression * p[2]});
      }
  return cloud;
}

Expected<Outcome> flight(const Bench& bench, unsigned level) {
  Scene scene;
  scene.fluid.spacing = kSize / kBlockResolution[level];
  scene.gravity[1] = 0;
  const auto start = StartFile::write(ball(scene.fluid.spacing));
  if (!start) return start.error();
  scene.fill.push_back(start->fill());
  Double3 speed{}, angularMomentum{};
  double momentumDrift = 0, angularMomentumDrift = 0;
  Curve angularMomenta;
  auto run = runSampled(
      bench, scene, 1, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const Double3 newSpeed = meanVelocity(cloud), newAngularMomentum = meanAngularMomentum(cloud);
        if (time == 0) {
          speed = newSpeed;
          angularMomentum = newAngularMomentum;
        }
        // This argument order propagates NaN.
        momentumDrift = std::max(length(difference(newSpeed, speed)) / length(speed), momentumDrift);
        angularMomentumDrift =
            std::max(length(difference(newAngularMomentum, angularMomentum)) / length(angularMomentum), angularMomentumDrift);
        angularMomenta.emplace_back(time, newAngularMomentum[2]);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  outcome.figures.push_back(plainFigure("momentum, drift", momentumDrift));
  outcome.figures.push_back(plainFigure("angular momentum, drift", angularMomentumDrift));
  outcome.figures.push_back(plainFigure("energy, peak", outcome.run.energy.ratio - 1));
  outcome.curves["angular_momentum_z_m2_s"] = curveJson(angularMomenta);
  return outcome;
}

}  // namespace

std::vector<Experiment> freeExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double spacing = kSize / kBlockResolution[level];
    all.push_back({"free-fall", level, level == 0, spacing, [level](const Bench& bench) { return fall(bench, level); }});
    all.push_back({"free-drop", level, level == 1, spacing, [level](const Bench& bench) { return flight(bench, level); }});
  }
  return all;
}

}  // namespace rill::bench
