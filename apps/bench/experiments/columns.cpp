// Martin and Moyce 1952: collapse of two columns. Scenes of assets/scenes/validation at other spacings.
#include <cmath>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"

namespace rill::bench {
namespace {

constexpr double kBase = 0.05715;  // a, m
constexpr double kColumnFrame = 1.0 / 240;
constexpr int kColumnResolution[kLevels] = {10, 16, 24};  // spacings per a; even, so that a / 2 is a multiple of the spacing

/// A published curve, and the units of its axes.
struct Measured {
  const char *figure, *file;
  double time, length;  // one unit of its axes, s and m
};

Expected<Outcome> collapse(const Bench& bench, int high, unsigned level) {
  const std::string which = std::to_string(high);
  auto scene = namedScene("validation/martin-moyce-" + which);
  if (!scene) return scene.error();
  scene->fluid.spacing = kBase / kColumnResolution[level];
  const double gravity = -scene->gravity[1];
  const Measured measured[] = {
      {"front", high == 1 ? "martin_moyce_n2_1_front" : "martin_moyce_n2_2_front", std::sqrt(kBase / (high * gravity)), kBase},
      {"height", high == 1 ? "martin_moyce_n2_1_height" : "martin_moyce_n2_2_height", std::sqrt(kBase / gravity), high * kBase}};
  Curve raw[2];  // s, m
  auto run = runSampled(
      bench, *scene, scene->duration, kColumnFrame, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        raw[0].emplace_back(time, frontAlongX(cloud));
        raw[1].emplace_back(time, heightAtWall(cloud, 0, 0));
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  for (size_t k = 0; k < 2; ++k) {
    const auto points = publishedCurve(measured[k].file);
    if (!points) return points.error();
    Curve curve;
    for (const auto& [time, length] : raw[k]) curve.emplace_back(time / measured[k].time, length / measured[k].length);
    const ShiftFit fit = fitShift(curve, *points);
    const std::string name = measured[k].figure;
    outcome.figures.push_back({name + ", shifted", fit.shifted, 0, fit.shifted});
    outcome.figures.push_back({name + ", unshifted", fit.unshifted, 0, fit.unshifted});
    outcome.figures.push_back({name + ", shift", fit.shift, 0, fit.shift});
    outcome.curves[name] = curveJson(curve);
    Curve shifted;
    for (const auto& [time, length] : curve) shifted.emplace_back(time + fit.shift, length);
    outcome.overlays.push_back({"column-" + which + "-" + name,
                                {"a / d = " + std::to_string(kColumnResolution[level]) + ", shifted by " + number(fit.shift, 2),
                                 Series::Style::Lines,
                                 shifted,
                                 {}}});
  }
  return outcome;
}

}  // namespace

std::vector<Experiment> columnExperiments() {
  std::vector<Experiment> all;
  for (const int high : {1, 2})
    for (unsigned level = 0; level < kLevels; ++level)
      all.push_back({"martin-moyce-" + std::to_string(high), level, level == 0, kBase / kColumnResolution[level],
                     [high, level](const Bench& bench) { return collapse(bench, high, level); }});
  return all;
}

}  // namespace rill::bench
