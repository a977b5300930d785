// The crown of a drop that falls onto a film: whether the fingers of its rim follow the lattice that the particles begin in.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"

namespace rill::bench {
namespace {

// The scene `crown`, with the lattices of film and drop turned about the vertical.
constexpr double kCrownHalfWidth = 0.013, kCrownFilm = 0.0012, kCrownDrop = 0.0027, kCrownSpeed = 2.5;  // m, m/s
constexpr double kCrownEnd = 1.0 / 150;                                                                 // s
constexpr int kCrownResolution[] = {3, 4};                                                              // spacings of film
constexpr int kCrownModes = 24;
using Rim = std::array<double, 72>;  // m, height by azimuth

Cloud turnedCrown(double spacing, double angle) {
  Cloud cloud{.position = {}, .velocity = {}, .spacing = spacing};
  const double c = std::cos(angle), s = std::sin(angle), inside = kCrownHalfWidth - 0.499 * spacing;
  const int film = static_cast<int>(std::lround(kCrownFilm / spacing)), wide = static_cast<int>(1.5 * kCrownHalfWidth / spacing);
  const int drop = static_cast<int>(kCrownDrop / spacing) + 1;
  const auto add = [&](double x, double y, double z, double speed) {
    cloud.position.push_back({c * x - s * z, y, c * z + s * x});
    cloud.velocity.push_back({0, speed, 0});
  };
  for (int i = -wide; i < wide; ++i)
    for (int k = -wide; k < wide; ++k) {
      const double x = (i + 0.5) * spacing, z = (k + 0.5) * spacing;
      if (std::max(std::abs(c * x - s * z), std::abs(c * z + s * x)) > inside) continue;
      for (int j = 0; j < film; ++j) add(x, (j + 0.5) * spacing, z, 0);
    }
  for (int i = -drop; i < drop; ++i)
    for (int j = -drop; j < drop; ++j)
      for (int k = -drop; k < drop; ++k) {
        const double x = (i + 0.5) * spacing, y = (j + 0.5) * spacing, z = (k + 0.5) * spacing;
        if (std::hypot(x, y, z) < kCrownDrop) add(x, film * spacing + kCrownDrop + spacing + y, z, -kCrownSpeed);
      }
  return cloud;
}

/// The highest fluid at each azimuth; the film's height where nothing stands above twice that.
Rim rimOf(const Cloud& cloud) {
  Rim rim;
  rim.fill(kCrownFilm);
  for (const Double3& p : cloud.position) {
    if (p.y < 2 * kCrownFilm) continue;
    const double turn = std::atan2(p.z, p.x) / (2 * std::numbers::pi) + 0.5;
    double& height = rim[std::min(static_cast<size_t>(turn * double(rim.size())), rim.size() - 1)];
    height = std::max(height, p.y);
  }
  return rim;
}

std::complex<double> modeOf(const Rim& rim, int n) {
  std::complex<double> sum = 0;
  for (size_t k = 0; k < rim.size(); ++k)
    sum += rim[k] * std::polar(2 / double(rim.size()), -n * ((double(k) + 0.5) / double(rim.size()) - 0.5) * 2 * std::numbers::pi);
  return sum;
}

/// Maxima that stand a spacing above the minima on both sides.
int fingersOf(const Rim& rim, double spacing) {
  const size_t first = static_cast<size_t>(std::min_element(rim.begin(), rim.end()) - rim.begin());
  int fingers = 0;
  bool rises = true;
  double extreme = rim[first];
  for (size_t k = 1; k <= rim.size(); ++k) {
    const double height = rim[(first + k) % rim.size()];
    if (rises == (height > extreme)) extreme = height;
    if (std::abs(height - extreme) < spacing) continue;
    fingers += rises && height < extreme;
    rises = !rises;
    extreme = height;
  }
  return fingers;
}

Expected<Outcome> crown(const Bench& bench, unsigned level, int degrees, double jitter) {
  const double spacing = kCrownFilm / kCrownResolution[level];
  const auto start = StartFile::write(turnedCrown(spacing, degrees * std::numbers::pi / 180));
  if (!start) return start.error();
  Scene scene = boxScene(spacing, {-kCrownHalfWidth, 0, -kCrownHalfWidth}, {kCrownHalfWidth, 0.03, kCrownHalfWidth});
  scene.fluid.density = 1030;
  scene.fluid.viscosity = 0.002;
  scene.fluid.surface_tension = 0.047;
  scene.solver.max_substeps = 256;
  scene.fill = {start->fill()};
  scene.fill[0].jitter = jitter;
  Rim rim{};
  auto run = runSampled(
      bench, scene, kCrownEnd, kCrownEnd / 2, [](double time) { return time > 0.75 * kCrownEnd; },
      [&](const Cloud& cloud, double) { rim = rimOf(cloud); });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  double all = 0, fourfold = 0, mean = 0;
  for (const double height : rim) mean += height / double(rim.size());
  std::vector<std::pair<double, double>> modes;
  for (int n = 1; n <= kCrownModes; ++n) {
    const double size = std::norm(modeOf(rim, n));
    all += size;
    if (n % 4 == 0) fourfold += size;
    modes.emplace_back(n, std::sqrt(size));
  }
  outcome.curves["modes of the rim"] = curveJson(modes);
  outcome.figures.push_back(plainFigure("fingers", fingersOf(rim, spacing)));
  outcome.figures.push_back(plainFigure("height of the rim", mean));
  outcome.figures.push_back(plainFigure("spread of its height", std::sqrt(all / 2)));
  outcome.figures.push_back(plainFigure("share of fourfold modes", fourfold / all));
  outcome.figures.push_back(plainFigure("turn of mode 4", -std::arg(modeOf(rim, 4)) / 4 * 180 / std::numbers::pi));
  outcome.figures.push_back(plainFigure("turn of mode 8", -std::arg(modeOf(rim, 8)) / 8 * 180 / std::numbers::pi));
  return outcome;
}

}  // namespace

std::vector<Experiment> crownExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < std::size(kCrownResolution); ++level)
    for (const int degrees : {0, 30})
      for (const double jitter : {0.0, 0.2})
        all.push_back({"crown-" + std::to_string(degrees) + (jitter > 0 ? "-jitter" : ""), level, false,
                       kCrownFilm / kCrownResolution[level], [=](const Bench& bench) { return crown(bench, level, degrees, jitter); }});
  return all;
}

}  // namespace rill::bench
