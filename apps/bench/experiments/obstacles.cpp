// A dam breaks over a box and over a ball: meshes of them against the exact shapes.
#include <algorithm>
#include <cmath>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/mesh_shapes.hpp"

namespace rill::bench {
namespace {

constexpr double kChannelLength = 3.2, kChannelWidth = 0.8;  // m, of the tank
constexpr double kColumnLength = 1.2, kColumnHeight = 0.8;   // m, of the column
constexpr double kObstacleTime = 2;                          // s: over the obstacle, up the wall, and back
constexpr double kObstacleSpacing[kLevels] = {0.05, 0.04, 0.025};
constexpr size_t kGauges = 4;  // parts of the tank along x, from the column's wall

const BoxShape kBox{{1.8, 0, 0.25}, {2.2, 0.4, 0.55}};
const SphereShape kBall{{2, 0.25, 0.4}, 0.25};

/// Volume of fluid in each part of the tank over the part's floor, m, frame by frame.
using Levels = std::vector<std::array<double, kGauges>>;

Expected<Levels> levelsOver(const Bench& bench, const Solid& obstacle, double spacing, RunFigures& figures) {
  Scene scene = boxScene(spacing, {0, 0, 0}, {kChannelLength, 2 * kColumnHeight, kChannelWidth});
  scene.fill.push_back(boxFill({0, 0, 0}, {kColumnLength, kColumnHeight, kChannelWidth}));
  scene.solids.push_back(obstacle);
  Levels levels;
  auto run = runSampled(
      bench, scene, kObstacleTime, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double) {
        auto& now = levels.emplace_back();
        for (const Double3& at : cloud.position)
          now[static_cast<size_t>(std::clamp(at.x / kChannelLength, 0.0, 0.999) * kGauges)] +=
              spacing * spacing * spacing / (kChannelLength / kGauges * kChannelWidth);
      });
  if (!run) return run.error();
  figures = std::move(*run);
  return levels;
}

/// Largest over the gauges of the root mean square over time, as a share of the depth.
double difference(const Levels& a, const Levels& b) {
  double worst = 0;
  for (size_t gauge = 0; gauge < kGauges; ++gauge) {
    double sum = 0;
    for (size_t k = 0; k < std::min(a.size(), b.size()); ++k) sum += std::pow(a[k][gauge] - b[k][gauge], 2);
    worst = std::max(worst, std::sqrt(sum / static_cast<double>(a.size())));
  }
  return worst / kColumnHeight;
}

/// `exact` against `mesh`, and, as the scatter that any change of the start brings, against itself moved by a hundredth of a spacing.
Expected<Outcome> compare(const Bench& bench, Solid exact, MeshData mesh, unsigned level) {
  const double spacing = kObstacleSpacing[level];
  auto made = Mesh::create(std::move(mesh));
  if (!made) return made.error();
  Solid meshed;
  meshed.shape = MeshShape{.mesh = *made};
  Outcome outcome;
  RunFigures unused;
  const auto first = levelsOver(bench, exact, spacing, unused);
  if (!first) return first.error();
  const auto second = levelsOver(bench, meshed, spacing, outcome.run);
  if (!second) return second.error();
  exact.motion = {{.at = 0, .translate = {0.01 * spacing, 0, 0}}};
  const auto moved = levelsOver(bench, exact, spacing, unused);
  if (!moved) return moved.error();
  outcome.figures.push_back(plainFigure("levels, mesh", difference(*first, *second)));
  outcome.figures.push_back(plainFigure("levels, scatter", difference(*first, *moved)));
  for (const auto& [name, levels] : {std::pair{"exact", &*first}, {"mesh", &*second}, {"moved", &*moved}}) outcome.curves[name] = *levels;
  return outcome;
}

}  // namespace

std::vector<Experiment> obstacleExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    all.push_back({"dam-over-box", level, level == 0, kObstacleSpacing[level],
                   [level](const Bench& bench) { return compare(bench, Solid{.shape = kBox}, boxMesh(kBox.min, kBox.max), level); }});
    all.push_back({"dam-over-ball", level, level == 0, kObstacleSpacing[level], [level](const Bench& bench) {
                     MeshData ball = ballMesh(kBall.radius, 5);
                     for (Double3& v : ball.vertices) v = {v.x + kBall.center.x, v.y + kBall.center.y, v.z + kBall.center.z};
                     return compare(bench, Solid{.shape = kBall}, std::move(ball), level);
                   }});
  }
  return all;
}

}  // namespace rill::bench
