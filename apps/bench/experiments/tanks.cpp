// Errors that the solver's kernel does not measure, in a still tank and a dam break: level, bulk density in a wider kernel, clumping,
// residual motion.
#include <cmath>
#include <numeric>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

constexpr double kSide = 0.8, kStillDepth = 1;  // m, still tank: leaves an interior farther than twice the support from all walls
constexpr double kStillSpacing[kLevels] = {1.0 / 15, 0.05, 1.0 / 30};
constexpr double kDamSpacing[kLevels] = {0.05, 1.0 / 30, 0.025};
constexpr double kTankFrame = 1.0 / 60;

bool near(double time_s, double instant_s) { return std::abs(time_s - instant_s) < kTankFrame / 2; }

void addBulk(Outcome& outcome, const BulkDensity& bulk, double clumped) {
  outcome.figures.push_back(plainFigure("bulk density", bulk.error));
  outcome.figures.push_back(plainFigure("clumped", clumped));
  outcome.curves["deep_particles"] = bulk.particles;
  outcome.curves["bulk_density_spread"] = bulk.spread;
  outcome.curves["bulk_density_profile"] = curveJson(bulk.profile);
}

/// Pressure from momentum: the force on the particles above a plane is their weight plus the rate of change of their momentum.
struct MomentumBalance {
  Cloud first;
  double begin = 0;
  double pressure(const Cloud& last, double end, double height, const Scene& scene, double area) const {
    double speed = 0, count = 0;
    for (size_t i = 0; i < first.size(); ++i)
      if (first.position[i][1] > height) {
        speed += last.velocity[i][1] - first.velocity[i][1];
        ++count;
      }
    const double mass = scene.fluid.density * std::pow(scene.fluid.spacing, 3);
    return mass * (count * -scene.gravity[1] + speed / (end - begin)) / area;
  }
};

Expected<Outcome> stillTank(const Bench& bench, unsigned level) {
  const double spacing = kStillSpacing[level];
  Scene scene = boxScene(spacing, {0, 0, 0}, {kSide, 2 * kStillDepth, kSide});
  scene.fill.push_back(boxFill({0, 0, 0}, {kSide, kStillDepth, kSide}));
  Outcome outcome;
  MomentumBalance balance;
  auto run = runSampled(
      bench, scene, 6, kTankFrame, [](double time) { return near(time, 4) || near(time, 6); },
      [&](const Cloud& cloud, double time) {
        if (near(time, 4)) balance = {cloud, time};
        if (!near(time, 6)) return;
        const double area = kSide * kSide, rest = double(cloud.size()) * std::pow(spacing, 3) / area;
        const double surface = surfaceLevel(cloud, 0, 0, kSide);
        outcome.figures.push_back(relativeFigure("level", surface, rest));
        outcome.figures.push_back(relativeFigure("twice the center of mass", 2 * meanPosition(cloud)[1], rest));
        double worst = 0;
        for (const double fraction : {0.0, 0.25, 0.5, 0.75}) {
          const double supported = balance.pressure(cloud, time, fraction * rest, scene, area),
                       hydrostatic = -scene.gravity[1] * scene.fluid.density * (rest - fraction * rest);
          const double error = (supported - hydrostatic) / (-scene.gravity[1] * scene.fluid.density * rest);
          outcome.curves["pressure"].push_back({{"height_m", fraction * rest}, {"held_Pa", supported}, {"hydrostatic_Pa", hydrostatic}});
          if (std::abs(error) > std::abs(worst)) worst = error;
        }
        outcome.figures.push_back(plainFigure("pressure", worst));
        addBulk(outcome, bulkDensity(cloud, wallsOf(scene), scene.fluid.smoothing_ratio * spacing), clumpedFraction(cloud));
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  const auto& instants = outcome.run.instants;
  const double mass = double(outcome.run.particles) * scene.fluid.density * std::pow(spacing, 3), weight = mass * -scene.gravity[1];
  Curve rmsSpeeds;
  for (const apps::Instant& instant : instants) rmsSpeeds.emplace_back(instant.time_s, std::sqrt(2 * instant.stats.kinetic_J / mass));
  for (const double time : {0.5, 2.0, 6.0})
    outcome.figures.push_back(plainFigure("rms speed, " + number(time) + " s", at(rmsSpeeds, time)));
  // Fluctuation of the load on the floor about its mean over the last two seconds.
  double sum = 0, squares = 0, count = 0;
  for (size_t k = 1; k < instants.size(); ++k)
    if (instants[k].time_s > 4) {
      const double force = 1 + (instants[k].stats.momentum[1] - instants[k - 1].stats.momentum[1]) / (kTankFrame * weight);
      sum += force;
      squares += force * force;
      ++count;
    }
  outcome.figures.push_back(plainFigure("floor load, rms", std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)))));
  outcome.figures.push_back(plainFigure("energy, end", outcome.run.energy.end_ratio - 1));
  outcome.figures.push_back(plainFigure("energy, peak", outcome.run.energy.ratio - 1));
  outcome.curves["rms_speed"] = curveJson(rmsSpeeds);
  outcome.overlays.push_back({"residual-motion", {"d = " + number(spacing) + " m", Series::Style::Lines, rmsSpeeds, {}}});
  return outcome;
}

Expected<Outcome> damBreak(const Bench& bench, unsigned level) {
  const double spacing = kDamSpacing[level];
  Scene scene = boxScene(spacing, {0, 0, 0}, {2, 2, 0.6});
  scene.fill.push_back(boxFill({0, 0, 0}, {1, 1, 0.6}));
  Outcome outcome;
  double clumped = 0;
  Curve density;
  auto run = runSampled(
      bench, scene, 2, kTankFrame, [](double time) { return near(std::fmod(time + kTankFrame / 4, 0.25), 0); },
      [&](const Cloud& cloud, double time) {
        clumped = std::max(clumped, clumpedFraction(cloud));
        const BulkDensity bulk = bulkDensity(cloud, wallsOf(scene), scene.fluid.smoothing_ratio * spacing);
        density.emplace_back(time, bulk.error);
        if (near(time, 2)) addBulk(outcome, bulk, clumped);
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  outcome.figures.push_back(plainFigure("energy, peak", outcome.run.energy.ratio - 1));
  outcome.curves["bulk_density"] = curveJson(density);
  return outcome;
}

}  // namespace

std::vector<Experiment> tankExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"still-tank", level, level == 1, kStillSpacing[level], [level](const Bench& bench) { return stillTank(bench, level); }});
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"dam-break", level, level == 0, kDamSpacing[level], [level](const Bench& bench) { return damBreak(bench, level); }});
  return all;
}

}  // namespace rill::bench
