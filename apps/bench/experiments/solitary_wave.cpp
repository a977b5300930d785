// A solitary wave over 20 depths: speed and height of its crest.
#include <algorithm>
#include <cmath>

#include "bench/experiments/start_file.hpp"
#include "bench/experiments/wave_starts.hpp"
#include "bench/experiments/waves.hpp"

namespace rill::bench {
namespace {

constexpr SolitaryWave kSolitary{.depth_m = 0.2, .height_m = 0.06};
constexpr int kSolitaryLayers[] = {8, 16};
constexpr int kSolitaryThickness = 4;
constexpr double kReach = 7 * kSolitary.depth_m;    // of the wave to each side, at the start and at the end
constexpr double kTravel = 20 * kSolitary.depth_m;  // m
constexpr double kSolitaryTank = 2 * kReach + kTravel;
constexpr double kSolitaryWindow = 2 * kSolitary.depth_m;  // full width of the Hann window, which is as wide as a bin of a depth

Expected<Outcome> travel(const Bench& bench, int layers) {
  const double spacing = kSolitary.depth_m / layers, frame = 1.0 / 60, duration = kTravel / kSolitary.speed();
  const auto start = StartFile::write(solitaryWave(kSolitary, kSolitaryTank, kReach, spacing, kSolitaryThickness));
  if (!start) return start.error();
  const double width = kSolitaryThickness * spacing;
  Scene scene = boxScene(spacing, {0, 0, 0}, {kSolitaryTank, 3 * kSolitary.depth_m, width});
  scene.fill.push_back(start->fill());
  const SurfaceWindow window{kSolitaryWindow / 2, kSolitaryTank - kSolitaryWindow / 2, spacing / 2, kSolitaryWindow, width};
  CrestFollower crest(kReach, kSolitary.depth_m / 2);
  auto run = runSampled(
      bench, scene, duration, frame, [](double) { return true; },
      [&](const Cloud& cloud, double time) { crest.follow(smoothSurface(cloud, window), time); });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  Curve path, over;  // without the first two depths, in which the wave adapts to the particles; height over depths traveled
  double last = 0, lastSamples = 0, ownSpeed = 0;
  const double first = crest.heights().front().second - kSolitary.depth_m;
  for (size_t k = 0; k < crest.positions().size(); ++k) {
    const auto [time, position] = crest.positions()[k];
    const double height = crest.heights()[k].second - kSolitary.depth_m;
    if (time * kSolitary.speed() > 2 * kSolitary.depth_m) {
      path.emplace_back(time, position);
      ownSpeed += SolitaryWave{.depth_m = kSolitary.depth_m, .height_m = kSolitary.height_m * height / first}.speed();
    }
    if (time * kSolitary.speed() > kTravel - 2 * kSolitary.depth_m) {
      last += height;
      lastSamples += 1;
    }
    over.emplace_back((position - kReach) / kSolitary.depth_m, height / first);
  }
  outcome.figures.push_back(relativeFigure("speed", slope(path), kSolitary.speed()));
  outcome.figures.push_back(relativeFigure("speed at its height", slope(path), ownSpeed / double(path.size())));
  outcome.figures.push_back(relativeFigure("height kept", last / lastSamples, first));
  outcome.curves["crest_m"] = curveJson(crest.positions());
  outcome.curves["surface_m"] = curveJson(crest.heights());
  outcome.overlays.push_back({"solitary", {std::to_string(layers) + " layers", Series::Style::Lines, over, {}}});
  return outcome;
}

}  // namespace

std::vector<Experiment> solitaryWaveExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < std::size(kSolitaryLayers); ++level) {
    const int layers = kSolitaryLayers[level];
    all.push_back({"solitary-" + std::to_string(layers), level, level == 0, kSolitary.depth_m / layers,
                   [layers](const Bench& bench) { return travel(bench, layers); }});
  }
  return all;
}

}  // namespace rill::bench
