// Balls that sink and rise in still water, a few spacings wide: their mean speed over the first 0.4 m.
#include <cmath>
#include <variant>

#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

constexpr double kGravity = 9.81;            // m/s^2
constexpr double kRadius = 0.06;             // m
constexpr double kWide = 0.48, kDeep = 0.9;  // m, of the water
constexpr double kFromEnd = 0.18;            // m, from the center to the surface or the floor at the start
constexpr double kPath = 0.4;                // m
constexpr double kHeld = 2, kLongest = 2;    // s: the start's waves are over; time for the travel at most
constexpr double kSpacing[kLevels] = {kRadius / 2, kRadius / 3, kRadius / 4};  // m
constexpr double kDragCoefficient = 0.44;  // of a sphere that is held, from a Reynolds number of 1,000 to 200,000

/// Seconds in which a ball of `ratio` times the water's density travels `distance` (m) from rest in water without bounds. Per mass of the
/// water that it displaces, (ratio + 1/2) dv/dt = |ratio - 1| g - 3 / (8 R) C v^2, with the added mass of a sphere and its drag.
double travelTime(double ratio, double distance) {
  const double drag = kDragCoefficient * 3 / (8 * kRadius * (ratio + 0.5));  // 1/m, over the speed's square
  const double terminal = std::sqrt(std::abs(ratio - 1) * kGravity / ((ratio + 0.5) * drag));
  return std::acosh(std::exp(drag * distance)) / (drag * terminal);
}

Expected<Outcome> travel(const Bench& bench, double ratio, double spacing) {
  const double start = ratio > 1 ? kDeep - kFromEnd : kFromEnd, sign = ratio > 1 ? -1 : 1;
  Scene scene = boxScene(spacing, {0, 0, 0}, {kWide, 1.3 * kDeep, kWide});
  scene.fill.push_back(boxFill({0, 0, 0}, {kWide, kDeep, kWide}));
  scene.solids.push_back(
      {.shape = SphereShape{{kWide / 2, start, kWide / 2}, kRadius}, .body = Body{.density = 1000 * ratio, .from = kHeld}, .name = "ball"});
  scene.probes.push_back({.name = "pose", .pose = "ball"});
  Outcome outcome;
  auto run = runScene(bench, {.scene = scene, .duration_s = kHeld + kLongest, .frame_s = 1.0 / 120});
  if (!run) return run.error();
  outcome.run = std::move(*run);
  std::vector<std::pair<double, double>> curve;
  double distance = 0, time = 0;  // m, s: of the path, or of as much of it as there is
  for (const apps::Instant& instant : outcome.run.instants) {
    const double since = instant.time_s - kHeld;
    if (since <= 0 || distance >= kPath) continue;
    const auto& pose = std::get<offline::PoseValue>(instant.stats.probes.front().second);
    const double speed = sign * pose.velocity.y;
    curve.emplace_back(since, speed);
    distance = sign * (pose.position.y - start);
    time = since;
    if (distance < kPath) continue;
    time -= (distance - kPath) / speed;  // it ended between two frames
    distance = kPath;
  }
  outcome.figures.push_back(relativeFigure("mean speed", distance / time, kPath / travelTime(ratio, kPath)));
  outcome.curves["speed"] = curveJson(curve);
  return outcome;
}

}  // namespace

std::vector<Experiment> sinkingExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double spacing = kSpacing[level];
    const auto add = [&](const char* family, double ratio) {
      all.push_back({family, level, level == 0, spacing, [=](const Bench& bench) { return travel(bench, ratio, spacing); }});
    };
    add("sinking-ball", 1.5);
    add("rising-ball", 0.3);
  }
  return all;
}

}  // namespace rill::bench
