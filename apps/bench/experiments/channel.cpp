// Laminar flow through a closed slit, from an emitter to an open side: plane Poiseuille flow downstream of the entrance.
#include <algorithm>
#include <cmath>

#include "bench/experiments/experiment.hpp"
#include "bench/experiments/inflow.hpp"

namespace rill::bench {
namespace {

constexpr double kSlitHigh = 0.1, kSlitLong = 0.4, kSlitWall = 0.05;  // m
constexpr double kSlitSpeed = 0.5, kSlitViscosity = 5;                // m/s, Pa s: a Reynolds number of 10
constexpr double kSlitPeak = 1.5;                                     // speed in the middle over the mean
constexpr double kSlitFrom = 1, kSlitEnd = 2;                         // s: the fluid is replaced once in 0.8 s
constexpr double kSlitSpacing[kLevels] = {kSlitHigh / 8, kSlitHigh / 12, kSlitHigh / 16};

/// Sums over the particles of a section, by height.
struct Profile {
  explicit Profile(size_t bins) : speed(bins, 0), members(bins, 0) {}
  std::vector<double> speed, members;
  double sum = 0, count = 0, middle = 0, nearMiddle = 0;

  void add(double y, double u, double spacing) {  // y: over the slit's height, u: over the mean speed
    sum += u, ++count;
    const auto n = std::min(speed.size() - 1, static_cast<size_t>(std::max(y, 0.0) * double(speed.size())));
    // Errors, not speeds: particles of a bin need not lie around its middle.
    speed[n] += u - 6 * y * (1 - y), ++members[n];
    if (std::abs(y - 0.5) * kSlitHigh < spacing) middle += u - 6 * y * (1 - y) + kSlitPeak, ++nearMiddle;
  }
};

Expected<Outcome> channel(const Bench& bench, double spacing) {
  const double wide = 8 * spacing;
  // Its floor and ceiling are solids, since its sides, unlike these, have no friction.
  Scene scene = boxScene(spacing, {0, -kSlitWall, 0}, {kSlitLong, kSlitHigh + kSlitWall, wide});
  scene.domain->open = 0b000010;
  scene.domain->open_removes = true;
  scene.gravity = {0, 0, 0};
  scene.duration = kSlitEnd;
  scene.fluid.viscosity = kSlitViscosity;
  scene.solids = {boxSolid({-kSlitWall, -2 * kSlitWall, -kSlitWall}, {kSlitLong, 0, wide + kSlitWall}, false),
                  boxSolid({-kSlitWall, kSlitHigh, -kSlitWall}, {kSlitLong, kSlitHigh + 2 * kSlitWall, wide + kSlitWall}, false)};
  scene.fill.push_back(boxFill({spacing, 0, 0}, {kSlitLong, kSlitHigh, wide}));
  scene.fill.back().velocity = {kSlitSpeed, 0, 0};
  scene.fill.back().jitter = 0.1;
  scene.emitters = {inflowAlongX(spacing / 2, 0, kSlitHigh, wide, kSlitSpeed)};
  Profile profile(static_cast<size_t>(std::round(kSlitHigh / spacing)));
  auto run = runSampled(
      bench, scene, kSlitEnd, 0.02, [](double time) { return time > kSlitFrom; },
      [&](const Cloud& cloud, double) {
        for (size_t i = 0; i < cloud.size(); ++i)
          if (cloud.position[i].x > 2 * kSlitHigh && cloud.position[i].x < 3 * kSlitHigh)
            profile.add(cloud.position[i].y / kSlitHigh, cloud.velocity[i].x / kSlitSpeed, spacing);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  std::vector<std::pair<double, double>> errors;
  double worst = 0;
  for (size_t n = 0; n < profile.speed.size(); ++n) {
    const double error = profile.speed[n] / profile.members[n];
    errors.emplace_back((double(n) + 0.5) / double(profile.speed.size()), error);
    worst = profile.members[n] > 0 ? std::max(worst, std::abs(error) / kSlitPeak) : INFINITY;
  }
  outcome.figures.push_back(relativeFigure("mean speed", profile.sum / profile.count, 1));
  outcome.figures.push_back(relativeFigure("speed in the middle", profile.middle / profile.nearMiddle, kSlitPeak));
  outcome.figures.push_back(plainFigure("profile, worst layer", worst));
  outcome.curves["error of the speed over height"] = curveJson(errors);
  return outcome;
}

}  // namespace

std::vector<Experiment> channelExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back(
        {"channel", level, level == 0, kSlitSpacing[level], [=](const Bench& bench) { return channel(bench, kSlitSpacing[level]); }});
  return all;
}

}  // namespace rill::bench
