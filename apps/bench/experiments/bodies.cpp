// Bodies: how deep boxes float, in one liquid and between two, which side turns up, how released balls start, heave, and momentum.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

constexpr double kGravity = 9.81;                                    // m/s^2
constexpr double kEdge = 0.3;                                        // m, of boxes, and the diameter of balls
constexpr double kWide = 0.8, kDeep = 0.6;                           // m, of the water
constexpr double kSpacing[kLevels] = {0.3 / 8, 0.3 / 12, 0.3 / 16};  // m

struct Sample {
  double time_s;
  offline::PoseValue pose;
  FluidStats stats;
};

/// The scene of water with one body, whose pose is probed.
Scene pool(double spacing, Solid body, double wide = kWide) {
  Scene scene = boxScene(spacing, {0, 0, 0}, {wide, 1.6 * kDeep, wide});
  scene.fill.push_back(boxFill({0, 0, 0}, {wide, kDeep, wide}));
  body.name = "body";
  scene.solids.push_back(std::move(body));
  scene.probes.push_back({.name = "pose", .pose = "body"});
  return scene;
}

Expected<std::vector<Sample>> follow(const Bench& bench, const Scene& scene, double duration, double frame, Outcome& outcome) {
  auto run = runScene(bench, {.scene = scene, .duration_s = duration, .frame_s = frame});
  if (!run) return run.error();
  outcome.run = std::move(*run);
  std::vector<Sample> samples;
  for (const apps::Instant& instant : outcome.run.instants)
    samples.push_back({instant.time_s, std::get<offline::PoseValue>(instant.stats.probes.front().second), instant.stats});
  return samples;
}

Solid boxAt(double low, double density, double height = kEdge) {
  constexpr double kLow = (kWide - kEdge) / 2, kHigh = (kWide + kEdge) / 2;
  return {.shape = BoxShape{{kLow, low, kLow}, {kHigh, low + height, kHigh}}, .body = Body{.density = density}};
}

/// Of the last second: the mean of what `value` gives.
template <class Value>
double lastMean(const std::vector<Sample>& samples, const Value& value) {
  double sum = 0, count = 0;
  for (const Sample& s : samples)
    if (s.time_s > samples.back().time_s - 1) sum += value(s), ++count;
  return sum / count;
}

/// Of the angle between the body's y axis and the vertical.
double cosineOfTilt(const Quaternion& q) { return 1 - 2 * (q.x * q.x + q.z * q.z); }

/// A low box, which is stable upright, is put where it should float. The expected level is that of the fluid's volume and of what the box
/// should displace.
Expected<Outcome> draught(const Bench& bench, double ratio, double spacing) {
  constexpr double kHeight = kEdge / 2;
  const double deep = ratio * kHeight, bottom = kDeep - deep;
  Scene scene = pool(spacing, boxAt(bottom, ratio * 1000, kHeight));
  Outcome outcome;
  auto samples = follow(bench, scene, 4, 1.0 / 60, outcome);
  if (!samples) return samples.error();
  const double middle = lastMean(*samples, [](const Sample& s) { return s.pose.position.y; });
  const double upright = lastMean(*samples, [](const Sample& s) { return cosineOfTilt(s.pose.rotation); });
  const double fluid = double(samples->front().stats.particles) * spacing * spacing * spacing;
  const double level = (fluid + deep * kEdge * kEdge) / (kWide * kWide);
  const double found = level - (middle - kHeight / 2);
  outcome.figures.push_back({"draught", found, deep, (found - deep) / spacing});
  outcome.figures.push_back(plainFigure("tilt", std::acos(std::min(upright, 1.0)) * 180 / std::numbers::pi));
  return outcome;
}

/// A low box between two liquids of equal depth, wholly submerged: its mass over that of the liquids that it displaces is 1 where a share
/// `ratio` of its height is in the heavy one. The expected level of the interface is that of the heavy liquid and of that share.
Expected<Outcome> draughtBetween(const Bench& bench, double ratio, double spacing) {
  constexpr double kHeight = kEdge / 2, kHeavy = 1000, kLight = 600;
  const double deep = ratio * kHeight;
  Scene scene = pool(spacing, boxAt(kDeep / 2 - deep, std::lerp(kLight, kHeavy, ratio), kHeight));
  scene.fluids = {{.name = "heavy", .density = kHeavy}, {.name = "light", .density = kLight}};
  scene.fill = {boxFill({0, 0, 0}, {kWide, kDeep / 2, kWide}), boxFill({0, kDeep / 2, 0}, {kWide, kDeep, kWide})};
  scene.fill.back().fluid = "light";
  Outcome outcome;
  auto samples = follow(bench, scene, 4, 1.0 / 60, outcome);
  if (!samples) return samples.error();
  const double middle = lastMean(*samples, [](const Sample& s) { return s.pose.position.y; });
  const double heavy = double(samples->front().stats.fluids.front().particles) * std::pow(spacing, 3);
  const double found = (heavy + deep * kEdge * kEdge) / (kWide * kWide) - (middle - kHeight / 2);
  outcome.figures.push_back({"draught", found, deep, (found - deep) / spacing});
  const double upright = lastMean(*samples, [](const Sample& s) { return cosineOfTilt(s.pose.rotation); });
  outcome.figures.push_back(plainFigure("tilt", std::acos(std::min(upright, 1.0)) * 180 / std::numbers::pi));
  return outcome;
}

/// A tall light box put upright, a little askew, ends on its side.
Expected<Outcome> righting(const Bench& bench, double spacing) {
  constexpr double kWidth = 0.16, kHeight = 0.4, kMiddle = kWide / 2;
  Solid box{.shape = BoxShape{{kMiddle - kWidth / 2, kDeep - kHeight / 2, kMiddle - kWidth / 2},
                              {kMiddle + kWidth / 2, kDeep + kHeight / 2, kMiddle + kWidth / 2}},
            .rotation = {0, 0, std::sin(0.05), std::cos(0.05)},
            .body = Body{.density = 500}};
  Outcome outcome;
  auto samples = follow(bench, pool(spacing, box), 6, 1.0 / 60, outcome);
  if (!samples) return samples.error();
  const double upright = lastMean(*samples, [](const Sample& s) { return std::abs(cosineOfTilt(s.pose.rotation)); });
  outcome.figures.push_back(plainFigure("long axis, from level", 90 - std::acos(std::min(upright, 1.0)) * 180 / std::numbers::pi));
  return outcome;
}

/// A ball is held under water until the start's waves are over, then released: its first acceleration, by the mean over 10 ms.
Expected<Outcome> released(const Bench& bench, double ratio, double spacing) {
  constexpr double kHeld = 2, kWindow = 0.01;
  Solid ball{.shape = SphereShape{{kWide / 2, kDeep / 2, kWide / 2}, kEdge / 2}, .body = Body{.density = 1000 * ratio, .from = kHeld}};
  Outcome outcome;
  auto samples = follow(bench, pool(spacing, ball), kHeld + 0.06, kWindow / 2, outcome);
  if (!samples) return samples.error();
  const double theory = kGravity * (1 - ratio) / (ratio + 0.5);
  std::vector<std::pair<double, double>> curve;
  for (const Sample& s : *samples) {
    const double since = s.time_s - kHeld;
    if (since < 1e-4) continue;
    const double mean = s.pose.velocity.y / since;
    curve.emplace_back(since, mean / theory);
    if (std::abs(since - kWindow) < 1e-4) outcome.figures.push_back(relativeFigure("first acceleration", mean, theory));
    if (std::abs(since - 5 * kWindow) < 1e-4) outcome.figures.push_back(relativeFigure("mean acceleration, 50 ms", mean, theory));
  }
  outcome.curves["mean acceleration"] = curveJson(curve);
  return outcome;
}

/// A ball of half of the water's density is held above where it floats, and released: the set-up of Kramer et al. (2021), "Highly accurate
/// experimental heave decay tests with a floating sphere", Energies 14, 269, whose damped period is 0.76 s. Its height after a period
/// follows from the added mass and the damping of a hemisphere that heaves (Hulme 1982, Journal of Fluid Mechanics 121), at that period
/// 0.422 and 0.239 of the displaced mass (and that times the frequency). The tank is so wide that no wave comes back in time.
Expected<Outcome> heave(const Bench& bench, double spacing) {
  constexpr double kHeld = 2, kDrop = 0.3 * kEdge, kTank = 1.8, kPeriod = 0.76, kAdded = 0.422, kDamping = 0.239;
  const double kept = std::exp(-std::numbers::pi * kDamping / (1 + kAdded));
  Solid ball{.shape = SphereShape{{kTank / 2, kDeep + kDrop, kTank / 2}, kEdge / 2}, .body = Body{.density = 500, .from = kHeld}};
  const Scene scene = pool(spacing, ball, kTank);
  constexpr double kFrame = 1.0 / 120;
  Outcome outcome;
  auto samples = follow(bench, scene, kHeld + 1.3 * kPeriod, kFrame, outcome);
  if (!samples) return samples.error();
  const double volume = std::pow(kEdge, 3) * std::numbers::pi / 6;
  // where it floats, in the water that there is
  const double rest = (double(samples->front().stats.particles) * std::pow(spacing, 3) + volume / 2) / (kTank * kTank);
  std::vector<std::pair<double, double>> curve;
  double lowest = 0, highest = -1, lowestAt = 0, highestAt = 0;
  for (const Sample& s : *samples) {
    const double since = s.time_s - kHeld, height = (s.pose.position.y - rest) / kDrop;
    if (since < -kFrame / 2) continue;
    curve.emplace_back(since, height);
    if (height < lowest) lowest = height, lowestAt = since, highest = height;
    if (since > lowestAt && height > highest) highest = height, highestAt = since;
  }
  outcome.figures.push_back(relativeFigure("period", highestAt, kPeriod));
  outcome.figures.push_back(relativeFigure("height after a period", highest, kept));
  outcome.curves["height over that of the start"] = curveJson(curve);
  return outcome;
}

/// A box that flies into a drop without gravity: the momentum of both.
Expected<Outcome> collision(const Bench& bench, double spacing) {
  Scene scene = boxScene(spacing, {-1, -1, -1}, {1, 1, 1});
  scene.domain.reset();
  scene.gravity = {0, 0, 0};
  scene.fill.push_back(boxFill({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}));
  scene.solids.push_back({.shape = BoxShape{{-0.15, -0.75, -0.15}, {0.15, -0.45, 0.15}},
                          .body = Body{.density = 700, .velocity = {0.3, 2, 0.1}},
                          .name = "body"});
  scene.probes.push_back({.name = "pose", .pose = "body"});
  Outcome outcome;
  auto samples = follow(bench, scene, 0.25, 1.0 / 60, outcome);
  if (!samples) return samples.error();
  const auto total = [](const Sample& s) {
    Double3 sum = s.stats.momentum;
    for (size_t a = 0; a < 3; ++a) sum[a] += s.stats.bodies->momentum[a];
    return sum;
  };
  const Double3 before = total(samples->front());
  double most = 0;
  for (const Sample& s : *samples) {
    const Double3 now = total(s);
    most = std::max(most, std::hypot(now.x - before.x, now.y - before.y, now.z - before.z));
  }
  outcome.figures.push_back(plainFigure("momentum of all", most / std::hypot(before.x, before.y, before.z)));
  return outcome;
}

}  // namespace

std::vector<Experiment> bodyExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double spacing = kSpacing[level];
    const auto add = [&](const std::string& family, auto run) {
      all.push_back({family, level, level == 0, spacing, [=](const Bench& bench) { return run(bench, spacing); }});
    };
    for (const auto& [name, ratio] : {std::pair{"0.3", 0.3}, {"0.5", 0.5}, {"0.8", 0.8}})
      add(std::string("draught-") + name, [r = ratio](const Bench& bench, double d) { return draught(bench, r, d); });
    for (const auto& [name, ratio] : {std::pair{"0.3", 0.3}, {"0.7", 0.7}})
      add(std::string("draught-between-") + name, [r = ratio](const Bench& bench, double d) { return draughtBetween(bench, r, d); });
    add("righting", righting);
    for (const auto& [name, ratio] : {std::pair{"0.1", 0.1}, {"0.5", 0.5}, {"2", 2.0}})
      add(std::string("released-ball-") + name, [r = ratio](const Bench& bench, double d) { return released(bench, r, d); });
    add("heave-ball", heave);
    add("body-and-drop", collision);
  }
  return all;
}

}  // namespace rill::bench
