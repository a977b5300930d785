#include "bench/experiments/wave_theory.hpp"

#include <cmath>
#include <numbers>

namespace rill::bench {

double StandingWave::waveNumber() const { return mode * std::numbers::pi / length_m; }
double StandingWave::frequency() const { return std::sqrt(gravity * waveNumber() * std::tanh(waveNumber() * depth_m)); }
double StandingWave::period() const { return 2 * std::numbers::pi / frequency(); }

Double3 StandingWave::shape(double x, double y) const {
  const double k = waveNumber(), scale = 1 / std::sinh(k * depth_m);
  return {-scale * std::sin(k * x) * std::cosh(k * y), scale * std::cos(k * x) * std::sinh(k * y), 0};
}

double StandingWave::secondOrder() const {
  // With omega0 = sqrt(tanh(k h)) and e = k a: omega = omega0 + e^2 omega2 / 2.
  const double steepness = waveNumber() * amplitude_m, first = std::sqrt(std::tanh(waveNumber() * depth_m));
  const double second = (9 * std::pow(first, -7) - 12 * std::pow(first, -3) - 3 * first - 2 * std::pow(first, 5)) / 32;
  return 0.5 * steepness * steepness * second / first;
}

double viscousDecay(double viscosity, double waveNumber, double frequency_radPerS) {
  const double rate = viscosity * waveNumber * waveNumber;
  return 2 * rate * (1 - std::sqrt(rate / (2 * frequency_radPerS)));
}

double SolitaryWave::speed() const { return std::sqrt(gravity * (depth_m + height_m)); }
double SolitaryWave::shape() const { return std::sqrt(0.75 * height_m / depth_m) / depth_m; }

double SolitaryWave::elevation(double fromCrest_m) const {
  const double c = std::cosh(shape() * fromCrest_m);
  return height_m / (c * c);
}

double SolitaryWave::crossSection(double from, double to) const {
  return height_m / shape() * (std::tanh(shape() * to) - std::tanh(shape() * from));
}

double SolitaryWave::velocity(double fromCrest_m) const {
  const double surface = elevation(fromCrest_m);
  return speed() * surface / (depth_m + surface);
}

double SolitaryWave::stretching(double fromCrest_m) const {
  const double surface = elevation(fromCrest_m), slope = -2 * shape() * std::tanh(shape() * fromCrest_m) * surface;
  return -speed() * depth_m * slope / ((depth_m + surface) * (depth_m + surface));
}

double levelShift(double length_m, double depth_m, double slope) { return slope * length_m * length_m / (12 * depth_m); }

}  // namespace rill::bench
