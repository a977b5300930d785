// Lift of held solids under water: a box, a ball, and the ball as a mesh.
#include <cmath>
#include <numbers>
#include <variant>

#include "bench/experiments/experiment.hpp"
#include "bench/mesh_shapes.hpp"

namespace rill::bench {
namespace {

constexpr double kLiftEdge = 0.4;                                         // m, of the box, and the ball's diameter
constexpr double kClearance = 9;                                          // spacings, from the solid to walls and surface
constexpr double kDuration = 3, kStill = 1.5;                             // s: the start's waves are over
constexpr double kLiftSpacing[kLevels] = {0.4 / 12, 0.4 / 16, 0.4 / 24};  // m

/// Width and depth of the water (m). In a gap of five spacings particles are in layers, which carry a part of the load.
double tankOf(double spacing) { return kLiftEdge + 2 * kClearance * spacing; }

Expected<Outcome> liftOf(const Bench& bench, Solid solid, double volume, double spacing) {
  const double tank = tankOf(spacing);
  Scene scene = boxScene(spacing, {0, 0, 0}, {tank, 1.4 * tank, tank});
  scene.fill.push_back(boxFill({0, 0, 0}, {tank, tank, tank}));
  solid.name = "held";
  scene.solids.push_back(std::move(solid));
  scene.probes.push_back({.name = "load", .load = "held"});
  Outcome outcome;
  auto run = runScene(bench, {.scene = scene, .duration_s = kDuration, .frame_s = 1.0 / 60});
  if (!run) return run.error();
  outcome.run = std::move(*run);
  double sum = 0, squares = 0, count = 0;
  std::vector<std::pair<double, double>> curve;
  const double weight = scene.fluid.density * -scene.gravity.y * volume;
  for (const apps::Instant& instant : outcome.run.instants) {
    const double lift = std::get<offline::LoadValue>(instant.stats.probes.front().second).force.y / weight;
    curve.emplace_back(instant.time_s, lift);
    if (instant.time_s < kStill) continue;
    sum += lift;
    squares += lift * lift;
    ++count;
  }
  const double mean = sum / count;
  outcome.figures.push_back(relativeFigure("lift", mean, 1));
  outcome.figures.push_back(plainFigure("lift, rms", std::sqrt(std::max(0.0, squares / count - mean * mean))));
  outcome.curves["lift"] = curveJson(curve);
  return outcome;
}

}  // namespace

std::vector<Experiment> liftExperiments() {
  constexpr double kRadius = kLiftEdge / 2;
  const double boxVolume = kLiftEdge * kLiftEdge * kLiftEdge, ballVolume = boxVolume * std::numbers::pi / 6;
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double spacing = kLiftSpacing[level], middle = tankOf(spacing) / 2, low = middle - kRadius, high = middle + kRadius;
    const auto add = [&](const char* family, double volume, auto makeSolid) {
      all.push_back({family, level, level == 0, spacing, [=](const Bench& bench) -> Expected<Outcome> {
                       Expected<Solid> solid = makeSolid();
                       if (!solid) return solid.error();
                       return liftOf(bench, std::move(*solid), volume, spacing);
                     }});
    };
    add("lift-box", boxVolume, [=]() -> Expected<Solid> { return Solid{.shape = BoxShape{{low, low, low}, {high, high, high}}}; });
    add("lift-ball", ballVolume, [=]() -> Expected<Solid> { return Solid{.shape = SphereShape{{middle, middle, middle}, kRadius}}; });
    add("lift-mesh-ball", ballVolume, [=]() -> Expected<Solid> {
      auto mesh = Mesh::create(ballMesh(kRadius, 4));
      if (!mesh) return mesh.error();
      return Solid{.shape = MeshShape{.mesh = *mesh}, .translation = {middle, middle, middle}};
    });
  }
  return all;
}

}  // namespace rill::bench
