#include "bench/experiments/wave_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace rill::bench {
namespace {

constexpr double kNoWave = std::numeric_limits<double>::quiet_NaN();

/// Weight of a Hann window of full width 1 about 0, with integral 1.
double hann(double x) { return std::abs(x) < 0.5 ? 1 + std::cos(2 * std::numbers::pi * x) : 0; }

/// Solves a symmetric positive system of three equations.
std::array<double, 3> solved(std::array<std::array<double, 4>, 3> rows) {
  for (size_t pivot = 0; pivot < 3; ++pivot)
    for (size_t row = 0; row < 3; ++row) {
      if (row == pivot || rows[pivot][pivot] == 0) continue;
      const double factor = rows[row][pivot] / rows[pivot][pivot];
      for (size_t column = pivot; column < 4; ++column) rows[row][column] -= factor * rows[pivot][column];
    }
  return {rows[0][3] / rows[0][0], rows[1][3] / rows[1][1], rows[2][3] / rows[2][2]};
}

/// The best offset, cosine and sine at a given frequency and decay.
DampedCosine amplitudesAt(const Curve& curve, double frequency, double decay) {
  std::array<std::array<double, 4>, 3> sums{};
  double squares = 0;
  for (const auto& [time, value] : curve) {
    const double damped = std::exp(-decay * (time - curve.front().first));
    const std::array<double, 4> terms{1, damped * std::cos(frequency * time), damped * std::sin(frequency * time), value};
    for (size_t row = 0; row < 3; ++row)
      for (size_t column = 0; column < 4; ++column) sums[row][column] += terms[row] * terms[column];
    squares += value * value;
  }
  const auto best = solved(sums);
  DampedCosine fit{frequency, decay, best[0], best[1], best[2]};
  const double explained = best[0] * sums[0][3] + best[1] * sums[1][3] + best[2] * sums[2][3], n = double(curve.size());
  const double about = squares - 2 * fit.offset * sums[0][3] + n * fit.offset * fit.offset;
  fit.residual = about > 0 ? std::sqrt(std::max(0.0, squares - explained) / about) : kNoWave;
  const double sinceZero = std::exp(decay * curve.front().first);  // the decay is counted from t = 0
  fit.cosine *= sinceZero;
  fit.sine *= sinceZero;
  return fit;
}

}  // namespace

double modalAmplitude(const Cloud& cloud, double waveNumber, double depth_m) {
  double sum = 0;
  for (const Double3& point : cloud.position) sum += std::cos(waveNumber * point[0]);
  return 2 * depth_m * sum / double(cloud.size());
}

double DampedCosine::period() const { return 2 * std::numbers::pi / frequency; }
double DampedCosine::keptPerPeriod() const { return std::exp(-decay * period()); }

DampedCosine fitDampedCosine(const Curve& curve, double expected_radPerS) {
  if (curve.size() < 8) return {kNoWave, kNoWave, kNoWave, kNoWave, kNoWave, kNoWave};
  // A scan finds the global minimum, then a pattern search refines it.
  double frequencyStep = 0.02 * expected_radPerS, decayStep = 0.02 * expected_radPerS;
  DampedCosine best = amplitudesAt(curve, expected_radPerS, 0);
  const auto attempt = [&](double frequency, double decay) {
    const DampedCosine fit = amplitudesAt(curve, frequency, decay);
    if (!(fit.residual < best.residual)) return false;
    best = fit;
    return true;
  };
  for (int f = -20; f <= 25; ++f)
    for (int d = -2; d <= 12; ++d) attempt(expected_radPerS + f * frequencyStep, d * decayStep);
  while (frequencyStep > 1e-6 * expected_radPerS) {
    const double frequency = best.frequency, decay = best.decay;
    bool moved = false;
    for (const double sign : {-1.0, 1.0}) {
      moved = attempt(frequency + sign * frequencyStep, decay) || moved;
      moved = attempt(frequency, decay + sign * decayStep) || moved;
    }
    if (moved) continue;
    frequencyStep /= 2;
    decayStep /= 2;
  }
  return best;
}

double windowMean(const Curve& curve, double from, double to) {
  double sum = 0, weights = 0;
  for (const auto& [time, value] : curve) {
    const double weight = hann((time - (from + to) / 2) / (to - from));
    sum += weight * value;
    weights += weight;
  }
  return weights > 0 ? sum / weights : kNoWave;
}

Curve smoothSurface(const Cloud& cloud, const SurfaceWindow& window) {
  Curve surface;
  const auto points = static_cast<size_t>((window.to_m - window.from_m) / window.step_m + 1e-9) + 1;
  for (size_t k = 0; k < points; ++k) surface.emplace_back(window.from_m + double(k) * window.step_m, 0);
  const double share = cloud.spacing * cloud.spacing * cloud.spacing / (window.width_m * window.window_m);
  for (const Double3& point : cloud.position) {
    const double first = (point[0] - window.window_m / 2 - window.from_m) / window.step_m,
                 last = (point[0] + window.window_m / 2 - window.from_m) / window.step_m;
    for (double k = std::max(0.0, std::ceil(first)); k <= std::min(last, double(points) - 1); ++k) {
      auto& [x, height] = surface[static_cast<size_t>(k)];
      height += share * hann((point[0] - x) / window.window_m);
    }
  }
  return surface;
}

void CrestFollower::follow(const Curve& surface, double time) {
  size_t best = surface.size();
  for (size_t k = 0; k < surface.size(); ++k)
    if (std::abs(surface[k].first - at_) <= reach_ && (best == surface.size() || surface[k].second > surface[best].second)) best = k;
  if (best == surface.size()) return;
  // Least squares of a parabola over equal steps, about the highest point.
  double position = surface[best].first, height = surface[best].second;
  const double step = surface.size() > 1 ? surface[1].first - surface[0].first : 0;
  const size_t half = std::min({step > 0 ? static_cast<size_t>(reach_ / 2 / step) : size_t{0}, best, surface.size() - 1 - best});
  if (half >= 1) {
    double n = 0, jj = 0, jjjj = 0, y = 0, jy = 0, jjy = 0;
    for (size_t k = best - half; k <= best + half; ++k) {
      const double j = double(k) - double(best), value = surface[k].second;
      n += 1;
      jj += j * j;
      jjjj += j * j * j * j;
      y += value;
      jy += j * value;
      jjy += j * j * value;
    }
    const double bend = (n * jjy - jj * y) / (n * jjjj - jj * jj), tilt = jy / jj, middle = (y - bend * jj) / n;
    const double offset = -tilt / (2 * bend);
    if (bend < 0 && std::abs(offset) <= double(half)) {
      position += offset * step;
      height = middle - tilt * tilt / (4 * bend);
    }
  }
  at_ = position;
  positions_.emplace_back(time, position);
  heights_.emplace_back(time, height);
}

}  // namespace rill::bench
