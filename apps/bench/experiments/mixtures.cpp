// Several fluids: layers at rest, a heavy layer over a light one (Rayleigh-Taylor), a lock exchange, and diffusion.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bench/experiments/curves.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/experiments/start_file.hpp"

namespace rill::bench {
namespace {

/// Heavy fluid in the first fill, so that its particles have the first ids, and light fluid in the second.
struct Mixture {
  Scene scene;
  size_t heavy = 0;  ///< particles of the heavy fluid
};

Expected<Mixture> mixture(Scene scene, double lightDensity) {
  constexpr double kHeavyDensity = 1000;
  scene.fluids = {{.name = "heavy", .density = kHeavyDensity}, {.name = "light", .density = lightDensity}};
  scene.fill.back().fluid = "light";
  const auto particles = makeParticles(scene);
  if (!particles) return particles.error();
  return Mixture{scene, static_cast<size_t>(std::ranges::count(particles->fluids, uint8_t{0}))};
}

constexpr double kMixtureFrame = 1.0 / 60;

// A tank of two layers of equal depth: pressure, level, speed, and the share of particles in the wrong layer.
constexpr double kLayerDepth = 0.3, kLayerSide = 0.3;  // m; multiples of the spacing
constexpr double kLayerSpacing[kLevels] = {0.3 / 8, 0.3 / 12, 0.3 / 16};
constexpr double kLayerEnd = 4;

Expected<Outcome> layers(const Bench& bench, unsigned level, double lightDensity) {
  const double spacing = kLayerSpacing[level];
  Scene tank = boxScene(spacing, {0, 0, 0}, {kLayerSide, 3 * kLayerDepth, kLayerSide});
  tank.fill = {boxFill({0, 0, 0}, {kLayerSide, kLayerDepth, kLayerSide}),
               boxFill({0, kLayerDepth, 0}, {kLayerSide, 2 * kLayerDepth, kLayerSide})};
  const double heights[] = {0.25 * kLayerDepth, 1.5 * kLayerDepth};
  for (const double y : heights) tank.probes.push_back({.name = number(y), .pressure = Double3{kLayerSide / 2, y, kLayerSide / 2}});
  const auto mixed = mixture(tank, lightDensity);
  if (!mixed) return mixed.error();
  Outcome outcome;
  double sunk = 0, levelAtEnd = 0, still = 0;
  auto run = runSampled(
      bench, mixed->scene, kLayerEnd, kMixtureFrame, [](double time) { return time > kLayerEnd - kMixtureFrame / 2; },
      [&](const Cloud& cloud, double) {
        const double rest = double(cloud.size()) * std::pow(spacing, 3) / (kLayerSide * kLayerSide);
        levelAtEnd = 2 * meanPosition(cloud)[1] / rest;
        double squares = 0;
        for (size_t i = 0; i < cloud.size(); ++i) {
          const Double3& v = cloud.velocity[i];
          squares += v.x * v.x + v.y * v.y + v.z * v.z;
          const double above = cloud.position[i].y - kLayerDepth;  // of the interface
          if (i < mixed->heavy ? above > spacing : above < -spacing) ++sunk;
        }
        sunk /= double(cloud.size());
        still = std::sqrt(squares / double(cloud.size()));
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  const double g = -mixed->scene.gravity[1];
  const auto exact = [&](double y) {
    const double light = lightDensity * g * (2 * kLayerDepth - std::max(y, kLayerDepth));
    return light + 1000 * g * std::max(kLayerDepth - y, 0.0);
  };
  double sums[std::size(heights)] = {}, count = 0;
  for (const apps::Instant& instant : outcome.run.instants) {
    if (instant.time_s < kLayerEnd - 1) continue;
    ++count;
    for (size_t k = 0; k < std::size(heights); ++k) sums[k] += std::get<offline::PressureValue>(instant.stats.probes[k].second).pressure;
  }
  const char* const names[] = {"pressure, in the heavy layer", "pressure, in the light layer"};
  for (size_t k = 0; k < std::size(heights); ++k) outcome.figures.push_back(relativeFigure(names[k], sums[k] / count, exact(heights[k])));
  outcome.figures.push_back(relativeFigure("level", levelAtEnd, 1));
  outcome.figures.push_back(plainFigure("rms speed", still));
  outcome.figures.push_back(plainFigure("in the wrong layer", sunk));
  return outcome;
}

// A heavy layer over a light one in a closed slab that starts with the velocities of the growing wave. The amplitude of the interface
// follows from the volume of the light fluid: A sinh(rate t), rate^2 = At g k tanh(k H) (Rayleigh 1883), At the Atwood number.
constexpr double kOverWidth = 0.4, kOverDepth = 0.2, kOverAmplitude = 0.004;  // m; the width is half a wavelength
constexpr double kOverLight = 500, kOverAtwood = 1.0 / 3;                     // kg/m^3
constexpr double kOverLow = 0.008, kOverHigh = 0.03;                          // m, of the amplitude: above noise, and still linear
constexpr double kOverSpacing[kLevels] = {1.0 / 60, 1.0 / 80, 1.0 / 100};

Expected<Outcome> rayleighTaylor(const Bench& bench, unsigned level) {
  const double spacing = kOverSpacing[level], wide = 6 * spacing, k = std::numbers::pi / kOverWidth;
  Scene slab = boxScene(spacing, {0, 0, 0}, {kOverWidth, 2 * kOverDepth, wide});
  const double expected = std::sqrt(kOverAtwood * -slab.gravity[1] * k * std::tanh(k * kOverDepth));
  const double speed = kOverAmplitude * expected / std::sinh(k * kOverDepth);
  Cloud heavy{.position = {}, .velocity = {}, .spacing = spacing}, light = heavy;
  const auto cells = [&](double length) { return static_cast<int>(std::round(length / spacing)); };
  for (int i = 0; i < cells(kOverWidth); ++i)
    for (int j = 0; j < cells(2 * kOverDepth); ++j)
      for (int n = 0; n < cells(wide); ++n) {
        const Double3 x{(i + 0.5) * spacing, (j + 0.5) * spacing, (n + 0.5) * spacing};
        const bool above = x.y > kOverDepth;
        const double from = above ? 2 * kOverDepth - x.y : x.y;  // the lid or the floor
        Cloud& own = above ? heavy : light;
        own.position.push_back(x);
        own.velocity.push_back(
            {(above ? 1 : -1) * speed * std::sin(k * x.x) * std::cosh(k * from), speed * std::cos(k * x.x) * std::sinh(k * from), 0});
      }
  const auto upper = StartFile::write(heavy), lower = StartFile::write(light);
  if (!upper) return upper.error();
  if (!lower) return lower.error();
  slab.fill = {upper->fill(), lower->fill()};
  const auto mixed = mixture(slab, kOverLight);
  if (!mixed) return mixed.error();

  Curve amplitudes, growth;
  Outcome outcome;
  auto run = runSampled(
      bench, mixed->scene, 4 / expected, 1.0 / 120, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        double sum = 0;
        for (size_t i = mixed->heavy; i < cloud.size(); ++i) sum += std::cos(k * cloud.position[i].x);
        const double amplitude = 2 * sum * std::pow(spacing, 3) / (kOverWidth * wide);
        amplitudes.emplace_back(time, amplitude);
        if (amplitude > kOverLow && amplitude < kOverHigh) growth.emplace_back(time, std::asinh(amplitude / kOverAmplitude));
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  outcome.curves["amplitude"] = curveJson(amplitudes);
  const double rate = growth.size() > 8 ? slope(growth) : std::numeric_limits<double>::quiet_NaN();
  outcome.figures.push_back(relativeFigure("growth rate", rate, expected));
  return outcome;
}

// Heavy fluid beside light fluid of the same depth: the front of the heavy one along the floor. Its speed over the square root of the
// reduced gravity times the depth is 0.5 without losses (Benjamin 1968), and 0.45 to 0.5 in experiments (Shin, Dalziel and Linden 2004).
constexpr double kLockDepth = 0.2, kLockLong = 1.6, kLockLight = 900;  // m, kg/m^3
constexpr double kLockLow = 0.45, kLockHigh = 0.5;
constexpr double kLockSpacing[kLevels] = {kLockDepth / 10, kLockDepth / 14, kLockDepth / 18};

Expected<Outcome> lockExchange(const Bench& bench, unsigned level) {
  const double spacing = kLockSpacing[level], wide = 6 * spacing;
  Scene tank = boxScene(spacing, {0, 0, 0}, {kLockLong, 2 * kLockDepth, wide});
  tank.fill = {boxFill({0, 0, 0}, {kLockLong / 2, kLockDepth, wide}), boxFill({kLockLong / 2, 0, 0}, {kLockLong, kLockDepth, wide})};
  const auto mixed = mixture(tank, kLockLight);
  if (!mixed) return mixed.error();
  const double speed = std::sqrt(-tank.gravity[1] * (1 - kLockLight / 1000) * kLockDepth);
  Curve front;
  auto run = runSampled(
      bench, mixed->scene, 7 * kLockDepth / speed, 1.0 / 30, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        std::vector<double> along;
        for (size_t i = 0; i < mixed->heavy; ++i)
          if (cloud.position[i].y < kLockDepth / 2) along.push_back(-cloud.position[i].x);
        if (along.empty()) return;
        const auto tip = along.begin() + std::min<std::ptrdiff_t>(12, std::ssize(along) - 1);  // behind a few that have mixed
        std::ranges::nth_element(along, tip);
        front.emplace_back(time, -*tip - kLockLong / 2);
      });
  if (!run) return run.error();
  Outcome outcome;
  outcome.run = std::move(*run);
  outcome.curves["front"] = curveJson(front);
  Curve steady;
  for (const auto& [time, x] : front)
    if (x > kLockDepth && x < 3 * kLockDepth) steady.emplace_back(time, x);
  const double froude = slope(steady) / speed, nearest = std::clamp(froude, kLockLow, kLockHigh);
  outcome.figures.push_back(relativeFigure("Froude number", froude, nearest));  // no error within what experiments gave
  return outcome;
}

// A still tank of two equal fluids side by side, of which one diffuses. Where its share is c = erfc(x / 2 sqrt(D t)) / 2, an amount of
// sqrt(D t / pi) a unit of area has passed. The walls are too far to matter.
constexpr double kMixLong = 0.4, kMixDepth = 0.2, kMixDiffusivity = 5e-4, kMixEnd = 2;  // m, m^2/s, s
constexpr double kMixSpacing[kLevels] = {kMixLong / 20, kMixLong / 30, kMixLong / 40};

Expected<Outcome> diffusion(const Bench& bench, unsigned level) {
  const double spacing = kMixSpacing[level], wide = 8 * spacing, middle = kMixLong / 2;
  Scene tank = boxScene(spacing, {0, 0, 0}, {kMixLong, 2 * kMixDepth, wide});
  tank.fluids = {{.name = "water"}, {.name = "milk", .diffusion = kMixDiffusivity}};
  tank.fill = {boxFill({0, 0, 0}, {middle, kMixDepth, wide}), boxFill({middle, 0, 0}, {kMixLong, kMixDepth, wide})};
  tank.fill.front().fluid = "milk";
  Outcome outcome;
  double squares = 0, passed = 0, all = 0;
  Curve profile;
  auto run = runSampled(
      bench, tank, kMixEnd, kMixtureFrame, [](double time) { return time > kMixEnd - kMixtureFrame / 2; },
      [&](const Cloud& cloud, double time) {
        for (size_t i = 0; i < cloud.size(); ++i) {
          const double x = cloud.position[i].x - middle, c = cloud.share.at(i);
          const double off = c - 0.5 * std::erfc(x / (2 * std::sqrt(kMixDiffusivity * time)));
          squares += off * off / double(cloud.size());
          passed += x > 0 ? c : 0;
          all += c;
          profile.emplace_back(x, c);
        }
        passed *= std::pow(spacing, 3) / (kMixDepth * wide);
        all *= std::pow(spacing, 3) / (middle * kMixDepth * wide);
      });
  if (!run) return run.error();
  outcome.run = std::move(*run);
  if (bench.stopped()) return outcome;
  outcome.curves["profile"] = curveJson(profile);
  outcome.figures.push_back(relativeFigure("amount that has passed", passed, std::sqrt(kMixDiffusivity * kMixEnd / std::numbers::pi)));
  outcome.figures.push_back(plainFigure("share, rms", std::sqrt(squares)));
  outcome.figures.push_back(relativeFigure("amount", all, 1));
  return outcome;
}

}  // namespace

std::vector<Experiment> mixtureExperiments() {
  std::vector<Experiment> all;
  for (const int ratio : {2, 10, 1000})
    for (unsigned level = 0; level < kLevels; ++level)
      all.push_back({"layers-" + std::to_string(ratio), level, ratio == 2 && level == 0, kLayerSpacing[level],
                     [level, ratio](const Bench& bench) { return layers(bench, level, 1000.0 / ratio); }});
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back(
        {"rayleigh-taylor", level, level == 0, kOverSpacing[level], [level](const Bench& bench) { return rayleighTaylor(bench, level); }});
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back(
        {"lock-exchange", level, level == 0, kLockSpacing[level], [level](const Bench& bench) { return lockExchange(bench, level); }});
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"diffusion", level, level == 0, kMixSpacing[level], [level](const Bench& bench) { return diffusion(bench, level); }});
  return all;
}

}  // namespace rill::bench
