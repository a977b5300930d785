// Water entry of a wedge at constant speed, in two dimensions: the force on it over that of the similarity solution of Zhao and Faltinsen
// (1993), "Water entry of two-dimensional bodies", Journal of Fluid Mechanics 246, table 1.
#include <cmath>
#include <memory>
#include <numbers>
#include <variant>

#include "bench/experiments/experiment.hpp"
#include "rill/mesh.hpp"

namespace rill::bench {
namespace {

constexpr double kDeadrise = std::numbers::pi / 6;   // between a face and the water
constexpr double kForce = 14.139;                    // over density, speed^3 and time, per length
constexpr double kSpeed = 3;                         // m/s: weight has little part in the force
constexpr double kRise = 0.3;                        // m, from the tip to the top
constexpr double kHalfTank = 1.2, kTankDepth = 0.6;  // m
constexpr double kStart = 1, kFinal = kRise / 2;     // s, of the descent; m, depth of the tip up to which the force is measured
constexpr double kEntrySpacing[kLevels] = {0.025, 0.0167, 0.0125};  // m
constexpr double kLayers = 8;                                       // spacings, thickness of the tank

/// A prism along z whose tip is at the origin.
Expected<std::shared_ptr<const Mesh>> wedge(double thickness) {
  const double half = kRise / std::tan(kDeadrise);
  MeshData data;
  for (const double z : {0.0, thickness})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {half, kRise}, {-half, kRise}}) data.vertices.push_back({x, y, z});
  data.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  return Mesh::create(std::move(data));
}

/// Weight of the water that the wedge displaces below the level, per length, N/m; the similarity solution has no gravity.
double buoyancy(double depth, double density, double gravity) { return density * gravity * depth * depth / std::tan(kDeadrise); }

Expected<Outcome> entryOf(const Bench& bench, double spacing) {
  const double thickness = kLayers * spacing;
  Scene scene = boxScene(spacing, {-kHalfTank, -kTankDepth, 0}, {kHalfTank, kRise + 4 * spacing, thickness});
  scene.fill.push_back(boxFill({-kHalfTank, -kTankDepth, 0}, {kHalfTank, 0, thickness}));
  auto mesh = wedge(thickness);
  if (!mesh) return mesh.error();
  const double above = 2 * spacing, travel = above + kFinal + spacing;
  scene.solids.push_back({.shape = MeshShape{.mesh = *std::move(mesh)},
                          .translation = {0, above, 0},
                          .motion = {{kStart}, {kStart + travel / kSpeed, {0, -travel, 0}}},
                          .name = "wedge"});
  scene.probes.push_back({.name = "load", .load = "wedge"});
  constexpr double kInterval = 1.0 / 240;
  Outcome outcome;
  auto run = runScene(bench, {.scene = scene, .duration_s = kStart + travel / kSpeed, .frame_s = kInterval});
  if (!run) return run.error();
  outcome.run = std::move(*run);
  std::vector<std::pair<double, double>> curve;
  double measured = 0, expected = 0;  // impulses from half of the final depth on, N s / m
  for (const apps::Instant& instant : outcome.run.instants) {
    const double depth = kSpeed * (instant.time_s - kInterval / 2 - kStart) - above;  // in the middle of the frame
    if (depth <= 0 || depth > kFinal) continue;
    const double force = std::get<offline::LoadValue>(instant.stats.probes.front().second).force.y / thickness -
                         buoyancy(depth, scene.fluid.density, -scene.gravity.y);
    const double theory = kForce * scene.fluid.density * kSpeed * kSpeed * depth;
    curve.emplace_back(depth, force / theory);
    if (depth < kFinal / 2) continue;
    measured += force * kInterval;
    expected += theory * kInterval;
  }
  outcome.figures.push_back(relativeFigure("force", measured, expected));
  outcome.curves["force over depth"] = curveJson(curve);
  return outcome;
}

}  // namespace

std::vector<Experiment> waterEntryExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double spacing = kEntrySpacing[level];
    all.push_back({"water-entry-wedge", level, level == 0, spacing, [=](const Bench& bench) { return entryOf(bench, spacing); }});
  }
  return all;
}

}  // namespace rill::bench
