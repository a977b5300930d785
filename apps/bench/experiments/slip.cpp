// No-slip: flow between plates, a plate that is towed, and a ball that falls in thick fluid.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

// Bits of SideMask.
constexpr SideMask kOpenX = 0b000011, kOpenZ = 0b110000;

// Of the plates, m; the fluid between them is so long that its ends do not matter in the middle.
constexpr double kPlateGap = 0.1, kPlateLong = 4 * kPlateGap, kPlateWide = kPlateGap;
constexpr double kPlateSpacing[kLevels] = {kPlateGap / 8, kPlateGap / 12, kPlateGap / 16};  // m
constexpr double kPlateViscosity = 20;                                                      // Pa s
constexpr double kPlateTime =
    0.5 * kPlateGap * kPlateGap * 1000 / kPlateViscosity;  // s: pi^2 / 2 times that of the slowest shear wave's decay
// The noise of the places that the fill starts with shifts particles, spacings.
constexpr double kPlateJitter = 0.1;

/// Fluid without weight between a floor and a ceiling, and open sides.
Scene betweenPlates(double spacing, double length, SideMask open) {
  Scene scene = boxScene(spacing, {0, 0, 0}, {length, kPlateGap, kPlateWide});
  scene.domain->open = static_cast<SideMask>(open | kOpenX | kOpenZ);
  scene.domain->slip = false;
  scene.gravity = {0, 0, 0};
  scene.fluid.viscosity = kPlateViscosity;
  Fill fill = boxFill({0, 0, 0}, {length, kPlateGap, kPlateWide});
  fill.jitter = kPlateJitter;
  scene.fill.push_back(fill);
  return scene;
}

/// A force along the plates, so weak that the fluid moves by less than a spacing: u = g y (H - y) / (2 nu).
Expected<Outcome> poiseuille(const Bench& bench, double spacing) {
  const double fastest = 0.1 * spacing / kPlateTime, viscosity = kPlateViscosity / 1000;
  Scene scene = betweenPlates(spacing, kPlateLong, 0);
  scene.gravity = {8 * viscosity * fastest / (kPlateGap * kPlateGap), 0, 0};
  Outcome outcome;
  double sum = 0, count = 0, middle = 0, nearMiddle = 0, worst = 0;
  std::vector<std::pair<double, double>> profile;
  auto run = runSampled(
      bench, scene, kPlateTime, kPlateTime / 4, [](double time) { return time > 0.9 * kPlateTime; },
      [&](const Cloud& cloud, double) {
        const auto layers = static_cast<size_t>(std::round(kPlateGap / spacing));
        std::vector<double> speed(layers, 0), height(layers, 0), members(layers, 0);
        for (size_t i = 0; i < cloud.size(); ++i) {
          if (std::abs(cloud.position[i].x - kPlateLong / 2) > kPlateGap / 2) continue;
          const double y = cloud.position[i].y, u = cloud.velocity[i].x / fastest;
          sum += u;
          ++count;
          const auto n = std::min(layers - 1, static_cast<size_t>(std::max(y, 0.0) / spacing));
          speed[n] += u, height[n] += y / kPlateGap, ++members[n];
          if (std::abs(y - kPlateGap / 2) < spacing) middle += u - 4 * y / kPlateGap * (1 - y / kPlateGap) + 1, ++nearMiddle;
        }
        for (size_t n = 0; n < layers; ++n) {
          if (members[n] == 0) {
            worst = std::numeric_limits<double>::infinity();
            continue;
          }
          const double y = height[n] / members[n], u = speed[n] / members[n];
          profile.emplace_back(y, u);
          worst = std::max(worst, std::abs(u - 4 * y * (1 - y)));
        }
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  const double decay =
      1 - 32 / std::pow(std::numbers::pi, 3) * std::exp(-std::numbers::pi * std::numbers::pi / 2);  // of the middle's start
  outcome.figures.push_back(relativeFigure("mean speed", sum / count, 2.0 / 3 * decay));
  outcome.figures.push_back(relativeFigure("speed in the middle", middle / nearMiddle, decay));
  outcome.figures.push_back(plainFigure("profile, worst layer", worst));
  outcome.curves["speed over height"] = curveJson(profile);
  return outcome;
}

struct Towed {
  RunFigures run;
  double force = 0;  ///< on the plate, N
  double worst = 0;  ///< deviation of a particle in the middle from the linear profile, over the plate's speed
};

/// A plate of this length (m) above the fluid moves at constant speed (m/s).
Expected<Towed> tow(const Bench& bench, double spacing, double length, double speed) {
  constexpr double kPlateThick = 0.05;
  Scene scene = betweenPlates(spacing, length, 0b001000);
  scene.solids.push_back({.shape = BoxShape{{0, kPlateGap, 0}, {length, kPlateGap + kPlateThick, kPlateWide}},
                          .slip = false,
                          .motion = {{0, {0, 0, 0}}, {10, {10 * speed, 0, 0}}},
                          .name = "plate"});
  scene.probes.push_back({.name = "load", .load = "plate"});
  Towed towed;
  auto run = runSampled(
      bench, scene, kPlateTime, kPlateTime / 8, [](double time) { return time > 0.95 * kPlateTime; },
      [&](const Cloud& cloud, double) {
        for (size_t i = 0; i < cloud.size(); ++i)
          if (std::abs(cloud.position[i].x - length / 2) < kPlateGap / 2)
            towed.worst = std::max(towed.worst, std::abs(cloud.velocity[i].x / speed - cloud.position[i].y / kPlateGap));
      });
  if (!run) return run.error();
  towed.run = std::move(*run);
  towed.force = -std::get<offline::LoadValue>(towed.run.instants.back().stats.probes.front().second).force.x;
  return towed;
}

/// The load of a plate is mu U / H times its area, but for what the free ends of the fluid take off: the difference of two lengths counts.
Expected<Outcome> towedPlate(const Bench& bench, double spacing) {
  const double speed = 0.1 * spacing / kPlateTime;
  const auto shorter = tow(bench, spacing, kPlateLong - kPlateGap, speed);
  if (!shorter) return shorter.error();
  auto longer = tow(bench, spacing, kPlateLong, speed);
  if (!longer) return longer.error();
  Outcome outcome;
  outcome.run = std::move(longer->run);
  outcome.figures.push_back(relativeFigure("force", longer->force - shorter->force, kPlateViscosity * speed * kPlateWide));
  outcome.figures.push_back(plainFigure("profile, worst particle", longer->worst));
  return outcome;
}

constexpr double kFallRadius = 0.04, kFallTank = 0.2, kFallDepth = 0.26;                       // m
constexpr double kBallSpacing[kLevels] = {kFallRadius / 4, kFallRadius / 5, kFallRadius / 6};  // m
constexpr double kFallViscosity = 50;                                                          // Pa s
constexpr double kFallRatio = 3;                                                               // density of the ball over the fluid's

/// What walls multiply Stokes' drag by, of a ball on the axis of a cylinder (Haberman and Sayre 1958; `lambda`: radii of ball and
/// cylinder).
double wallFactor(double lambda) {
  const double l2 = lambda * lambda, l3 = l2 * lambda, l5 = l3 * l2, l6 = l5 * lambda;
  return (1 - 0.75857 * l5) / (1 - 2.1050 * lambda + 2.0865 * l3 - 1.7068 * l5 + 0.72603 * l6);
}

/// Slow fall in a square tank, which counts as the cylinder that has the same first-order factor: Happel and Bart (1974) give
/// 1 + 1.9033 a / l for half of the tank's width l, where a cylinder has 1 + 2.105 a / R.
Expected<Outcome> fallingBall(const Bench& bench, double spacing) {
  constexpr double kFallGravity = 9.81, kFallFrame = 0.01;
  constexpr double kFallHeld = 0.2, kFallFrom = 0.26, kFallEnd = 0.36;  // s; R^2 / nu is 0.03 s
  Scene scene = boxScene(spacing, {0, 0, 0}, {kFallTank, 1.2 * kFallDepth, kFallTank});
  scene.domain->slip = false;
  scene.fluid.viscosity = kFallViscosity;
  scene.fill.push_back(boxFill({0, 0, 0}, {kFallTank, kFallDepth, kFallTank}));
  scene.solids.push_back({.shape = SphereShape{{kFallTank / 2, 0.55 * kFallDepth, kFallTank / 2}, kFallRadius},
                          .slip = false,
                          .body = Body{.density = 1000 * kFallRatio, .from = kFallHeld},
                          .name = "ball"});
  scene.probes.push_back({.name = "pose", .pose = "ball"});
  Outcome outcome;
  auto run = runScene(bench, {.scene = scene, .duration_s = kFallEnd, .frame_s = kFallFrame});
  if (!run) return run.error();
  outcome.run = std::move(*run);
  std::vector<std::pair<double, double>> curve;
  double from = 0, to = 0;
  for (const apps::Instant& instant : outcome.run.instants) {
    const auto pose = std::get<offline::PoseValue>(instant.stats.probes.front().second);
    curve.emplace_back(instant.time_s, pose.velocity.y);
    if (instant.time_s < kFallFrom + 1e-6) from = pose.position.y;
    to = pose.position.y;
  }
  const double stokes = 2.0 / 9 * 1000 * (kFallRatio - 1) * kFallGravity * kFallRadius * kFallRadius / kFallViscosity;
  const double expected = stokes / wallFactor(kFallRadius / (kFallTank / 2) * 1.9033 / 2.105);
  outcome.figures.push_back(relativeFigure("terminal velocity", (from - to) / (kFallEnd - kFallFrom), expected));
  outcome.curves["velocity"] = curveJson(curve);
  return outcome;
}

}  // namespace

std::vector<Experiment> slipExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const auto add = [&](const char* family, double spacing, auto run) {
      all.push_back({family, level, level == 0, spacing, [=](const Bench& bench) { return run(bench, spacing); }});
    };
    add("poiseuille", kPlateSpacing[level], poiseuille);
    add("towed-plate", kPlateSpacing[level], towedPlate);
    add("falling-ball", kBallSpacing[level], fallingBall);
  }
  return all;
}

}  // namespace rill::bench
