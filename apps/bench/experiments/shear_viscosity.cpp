// Viscosity that depends on shear: flow between plates, and cylinders of mud that slump.
#include "sph/shear_viscosity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"

namespace rill::bench {
namespace {

constexpr double kMudDensity = 1000;

void setRheology(Scene& scene, const Rheology& rheology) {
  scene.fluid.density = kMudDensity;
  scene.fluid.viscosity = rheology.consistency;
  scene.fluid.yield_stress = rheology.yieldStress;
  scene.fluid.flow_index = rheology.flowIndex;
}

constexpr double kMudGap = 0.1, kMudLong = 4 * kMudGap;  // m
constexpr double kMudSpacing[kLevels] = {kMudGap / 8, kMudGap / 12, kMudGap / 16};
constexpr double kMudSpeed = 0.1, kMudTime = 0.4;  // m/s in the middle, s: the fluid moves by four tenths of the gap

/// Fluid of Herschel and Bulkley between plates, over the speed in the middle; y: from there, over half of the gap, `plug` likewise.
double plateProfile(double flowIndex, double plug, double y) {
  const double exponent = 1 / flowIndex + 1;
  return 1 - std::pow(std::max(std::abs(y) - plug, 0.0) / (1 - plug), exponent);
}

/// The body force moves the middle, where the stress is below the yield stress, by kMudSpeed.
Expected<Outcome> plates(const Bench& bench, double spacing, double consistency, double flowIndex, double plug) {
  const double half = kMudGap / 2, exponent = 1 / flowIndex + 1;
  const double gradient = consistency * std::pow(kMudSpeed * exponent / std::pow(half * (1 - plug), exponent), flowIndex);
  Scene scene = boxScene(spacing, {0, 0, 0}, {kMudLong, kMudGap, kMudGap});
  scene.domain->open = 0b110011;
  scene.domain->slip = false;
  scene.gravity = {gradient / kMudDensity, 0, 0};
  setRheology(scene, {consistency, plug * half * gradient, flowIndex});
  scene.fill.push_back(boxFill({0, 0, 0}, {kMudLong, kMudGap, kMudGap}));
  scene.fill.back().jitter = 0.1;
  double sum = 0, expected = 0, middle = 0, nearMiddle = 0, worst = 0;
  std::vector<std::pair<double, double>> profile;
  auto run = runSampled(
      bench, scene, kMudTime, kMudTime / 20, [](double time) { return time > 0.9 * kMudTime; },
      [&](const Cloud& cloud, double) {
        const auto layers = static_cast<size_t>(std::round(kMudGap / spacing));
        std::vector<double> error(layers, 0), members(layers, 0);
        const double from = kMudLong / 2 + kMudSpeed * kMudTime / 2;
        for (size_t i = 0; i < cloud.size(); ++i) {
          if (std::abs(cloud.position[i].x - from) > half) continue;
          const double y = cloud.position[i].y, u = cloud.velocity[i].x / kMudSpeed;
          const double exact = plateProfile(flowIndex, plug, y / half - 1);
          sum += u, expected += exact;
          if (std::abs(y - half) < spacing) middle += u - exact + 1, ++nearMiddle;
          const auto n = std::min(layers - 1, static_cast<size_t>(std::max(y, 0.0) / spacing));
          error[n] += u - exact, ++members[n];
          profile.emplace_back(y / kMudGap, u);
        }
        for (size_t n = 0; n < layers; ++n)
          worst = std::max(worst, members[n] > 0 ? std::abs(error[n] / members[n]) : std::numeric_limits<double>::infinity());
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  outcome.figures.push_back(relativeFigure("mean speed", sum, expected));
  outcome.figures.back().measured /= expected, outcome.figures.back().expected = 1;
  outcome.figures.push_back(relativeFigure("speed in the middle", middle / nearMiddle, 1));
  outcome.figures.push_back(plainFigure("profile, worst layer", worst));
  outcome.curves["speed over height"] = curveJson(profile);
  return outcome;
}

constexpr double kSlumpHigh = 0.1, kSlumpGravity = 9.81, kSlumpConsistency = 10, kSlumpEnd = 1.2;  // m, m/s^2, Pa s, s
constexpr int kSlumpLayers[kLevels] = {12, 16, 20};

/// What is left of a cylinder's height, over it: the layers of a column yield whose own weight is more than `held` times the yield stress
/// (Murata 1984; Pashias et al. 1996, with 2, for Tresca's criterion: the shear stress is half of the weight). For that of von Mises, which
/// sqrt(2 D : D) makes, it is the root of 3 (Roussel and Coussot 2005).
double slumpedHeight(double yieldStress, double held) {
  const double stands = held * yieldStress / (kMudDensity * kSlumpGravity * kSlumpHigh);
  return stands * (1 - std::log(stands));
}

/// `yield`: stress over the weight of the column. The floor has no friction, as in the theory.
Expected<Outcome> slump(const Bench& bench, unsigned level, double yield) {
  const double spacing = kSlumpHigh / kSlumpLayers[level], radius = kSlumpHigh / 2,
               stress = yield * kMudDensity * kSlumpGravity * kSlumpHigh;
  Cloud start;
  start.spacing = spacing;
  const int across = kSlumpLayers[level] / 2 + 1;
  for (int i = -across; i < across; ++i)
    for (int k = -across; k < across; ++k)
      for (int j = 0; j < kSlumpLayers[level]; ++j)
        if (const Double3 p = {(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing}; std::hypot(p.x, p.z) < radius)
          start.position.push_back(p);
  start.velocity.resize(start.position.size());
  const auto file = StartFile::write(start);
  if (!file) return file.error();
  const double wide = 5 * radius;
  Scene scene = boxScene(spacing, {-wide, 0, -wide}, {wide, 1.5 * kSlumpHigh, wide});
  scene.domain->open = 0b111011;
  setRheology(scene, {kSlumpConsistency, stress, 1});
  scene.fill = {file->fill()};
  Curve heights;
  auto run = runSampled(
      bench, scene, kSlumpEnd, 0.05, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        // The mean of the highest, one a spacing squared.
        std::vector<double> high;
        for (const Double3& p : cloud.position)
          if (std::hypot(p.x, p.z) < 0.5 * radius) high.push_back(p.y);
        std::ranges::sort(high, std::greater());
        high.resize(std::min(high.size(), static_cast<size_t>(std::numbers::pi * std::pow(0.5 * radius / spacing, 2))));
        double sum = 0;
        for (const double y : high) sum += y + spacing / 2;
        heights.emplace_back(time, sum / double(high.size()) / kSlumpHigh);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  const double height = heights.back().second;
  outcome.figures.push_back(relativeFigure("height", height, slumpedHeight(stress, std::sqrt(3.0))));
  outcome.figures.push_back(relativeFigure("height, by Tresca", height, slumpedHeight(stress, 2)));
  const auto& before = heights[heights.size() - 7];
  outcome.figures.push_back(plainFigure("creep", (before.second - height) / height / (heights.back().first - before.first)));
  outcome.curves["height"] = curveJson(heights);
  return outcome;
}

}  // namespace

std::vector<Experiment> shearExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level) {
    const double gap = kMudSpacing[level];
    all.push_back({"bingham-plates", level, level == 0, gap, [=](const Bench& bench) { return plates(bench, gap, 20, 1, 0.4); }});
    all.push_back({"thinning-plates", level, level == 0, gap, [=](const Bench& bench) { return plates(bench, gap, 40, 0.5, 0); }});
    all.push_back({"thickening-plates", level, false, gap, [=](const Bench& bench) { return plates(bench, gap, 10, 1.5, 0); }});
    for (const double yield : {0.15, 0.2})
      all.push_back({"slump-" + number(yield), level, level == 0 && yield == 0.2, kSlumpHigh / kSlumpLayers[level],
                     [=](const Bench& bench) { return slump(bench, level, yield); }});
  }
  return all;
}

}  // namespace rill::bench
