#pragma once
// Light of a clear sky by random paths, in one band of wavelengths and without tables.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "rill/vectors.hpp"

namespace rill::test {
namespace brute_force_sky {

inline constexpr double kGround = 6360, kTop = 6460;  // km from the center of the Earth

inline double dotOf(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Double3 scaled(double s, const Double3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Double3 sumOf(const Double3& a, const Double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline double lengthOf(const Double3& a) { return std::sqrt(dotOf(a, a)); }

/// Unit vector at an angle with this cosine to `axis`.
inline Double3 turned(const Double3& axis, double cosine, double turn) {
  const Double3 other = std::abs(axis.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0};
  Double3 u = {axis.y * other.z - axis.z * other.y, axis.z * other.x - axis.x * other.z, axis.x * other.y - axis.y * other.x};
  u = scaled(1 / lengthOf(u), u);
  const Double3 v = {axis.y * u.z - axis.z * u.y, axis.z * u.x - axis.x * u.z, axis.x * u.y - axis.y * u.x};
  const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
  return sumOf(scaled(cosine, axis), sumOf(scaled(sine * std::cos(turn), u), scaled(sine * std::sin(turn), v)));
}

/// Coefficients at the ground, 1/km, of exponential profiles with scale heights of 8 and 1.2 km; ozone in a tent of 25 km +- 15 km.
struct Air {
  double rayleigh, aerosols, ozone, groundAlbedo;

  struct At {
    double rayleigh, mie, extinction;
  };
  At at(double height) const {
    const double r = rayleigh * std::exp(-height / 8), m = aerosols * std::exp(-height / 1.2);
    return {r, 0.9 * m, r + m + ozone * std::max(1 - std::abs(height - 25) / 15, 0.0)};
  }

  static double toSphere(const Double3& from, const Double3& to, double radius, bool far) {
    const double along = dotOf(from, to), under = along * along - dotOf(from, from) + radius * radius;
    if (under < 0) return -1;
    return -along + (far ? 1 : -1) * std::sqrt(under);
  }

  double transmittance(const Double3& from, const Double3& to) const {
    if (dotOf(from, to) < 0 && toSphere(from, to, kGround, false) >= 0) return 0;
    constexpr int kSteps = 150;
    const double length = toSphere(from, to, kTop, true);
    double depth = 0;
    for (int k = 0; k < kSteps; ++k) {
      const double a = double(k) / kSteps, b = double(k + 1) / kSteps;
      const double height = lengthOf(sumOf(from, scaled(0.5 * (a * a + b * b) * length, to))) - kGround;
      depth += at(height).extinction * (b * b - a * a) * length;
    }
    return std::exp(-depth);
  }

  double phase(const At& air, double cosine) const {
    constexpr double g = 0.8, kSphere = 4 * std::numbers::pi;
    const double molecules = 0.75 / kSphere * (1 + cosine * cosine);
    const double aerosol = 1.5 / kSphere * (1 - g * g) / (2 + g * g) * (1 + cosine * cosine) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
    return (air.rayleigh * molecules + air.mie * aerosol) / (air.rayleigh + air.mie);
  }
};

struct Estimate {
  double once, all;  // radiance of light that was scattered once, and of all
};

/// What an eye on the ground sees towards `sight`, for a sun of irradiance 1: `paths` paths with collisions found by Woodcock tracking.
inline Estimate radiance(const Air& air, const Double3& sight, const Double3& sun, int paths) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit;
  const double most = air.rayleigh + air.aerosols + air.ozone;
  Estimate out = {0, 0};
  for (int path = 0; path < paths; ++path) {
    Double3 place = {0, kGround + 1e-4, 0}, to = sight;
    double weight = 1;
    for (int order = 0; weight > 0.01; ++order) {
      const double ground = dotOf(place, to) < 0 ? Air::toSphere(place, to, kGround, false) : -1;
      const double end = ground >= 0 ? ground : Air::toSphere(place, to, kTop, true);
      double distance = 0;
      Air::At here = {0, 0, 0};
      while (true) {
        // Upward nothing is denser than here, but for ozone.
        const Double3 from = sumOf(place, scaled(distance, to));
        const double bound = dotOf(from, to) > 0 ? air.at(lengthOf(from) - kGround).extinction + air.ozone : most;
        distance -= std::log(1 - unit(random)) / bound;
        if (distance >= end) break;
        here = air.at(lengthOf(sumOf(place, scaled(distance, to))) - kGround);
        if (unit(random) * bound < here.extinction) break;
      }
      if (distance >= end && ground < 0) break;
      place = sumOf(place, scaled(std::min(distance, end), to));
      if (distance >= end) {
        const Double3 up = scaled(1 / lengthOf(place), place);
        place = scaled(kGround + 1e-4, up);
        weight *= air.groundAlbedo;
        out.all += weight / std::numbers::pi * std::max(dotOf(up, sun), 0.0) * air.transmittance(place, sun);
        to = turned(up, std::sqrt(unit(random)), 2 * std::numbers::pi * unit(random));
        continue;
      }
      weight *= (here.rayleigh + here.mie) / here.extinction;
      const double light = weight * air.phase(here, dotOf(to, sun)) * air.transmittance(place, sun);
      out.all += light;
      if (order == 0) out.once += light;
      // Henyey-Greenstein's function or none, then the share 1 + cosine^2 that both phase functions have
      const bool molecule = unit(random) * (here.rayleigh + here.mie) < here.rayleigh;
      double cosine = 0;
      do {
        const double g = 0.8, root = (1 - g * g) / (1 - g + 2 * g * unit(random));
        cosine = molecule ? 2 * unit(random) - 1 : (1 + g * g - root * root) / (2 * g);
      } while (unit(random) * 2 > 1 + cosine * cosine);
      to = turned(to, cosine, 2 * std::numbers::pi * unit(random));
    }
  }
  out.once /= paths;
  out.all /= paths;
  return out;
}

}  // namespace brute_force_sky
}  // namespace rill::test
