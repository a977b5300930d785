#include "render/atmosphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill {
namespace {

constexpr double kTurn = 2 * std::numbers::pi, kSphere = 2 * kTurn;
constexpr double kAirHeight = kAirTop - kGroundRadius;

// Values of the paper's table 1, by wavelength; the share that aerosols scatter is that of Bruneton and Neyret (2008).
constexpr double kRayleigh = 0.013558;                 // at 550 nm; by the fourth power of the wavelength those at 680 and 440 nm
constexpr double kRayleighScale = 8, kMieScale = 1.2;  // height over which the density falls to 1/e
constexpr double kMieAlbedo = 3.996 / 4.44;            // share of extinction that is scattering
constexpr double kMieAsymmetry = 0.8;
// Of what aerosols scatter, the peak ahead: it is taken not to be scattered (delta-M, Wiscombe 1977) but in the first order, whose phase
// function is exact (Nakajima and Tanaka 1988). By comparison with random paths; the square of the asymmetry is 0.64.
constexpr double kAhead = 0.55;
constexpr double kOzone = 5.374e-4;  // 300 Dobson units: 5.374e18 molecules/m3 at most, by 1e-25 m2
constexpr double kOzoneHeight = 25, kOzoneWidth = 15;
// Of the extinction of aerosols over the land, by wavelength (Angstrom 1929); the paper has 0.
constexpr double kAngstrom = 1.3;

constexpr int kTransmittanceSteps = 40, kScatterSteps = 20, kGatherSteps = 48;
constexpr int kTurns = 8, kTilts = 8;  // directions over the sphere

double radiusAfter(double radius, double cosine, double distance) {
  return std::sqrt(std::max(distance * distance + 2 * radius * cosine * distance + radius * radius, 0.0));
}

/// A quarter of the discriminant of the distances at which a ray that starts at `radius` meets a sphere; negative if it misses.
double crossing(double radius, double cosine, double sphere) { return radius * radius * (cosine * cosine - 1) + sphere * sphere; }

bool meetsGround(double radius, double cosine) { return cosine < 0 && crossing(radius, cosine, kGroundRadius) >= 0; }

double distanceToTop(double radius, double cosine) {
  return -radius * cosine + std::sqrt(std::max(crossing(radius, cosine, kAirTop), 0.0));
}

double distanceToGround(double radius, double cosine) {
  return -radius * cosine - std::sqrt(std::max(crossing(radius, cosine, kGroundRadius), 0.0));
}

/// From a point on the horizon that is seen from `radius`.
double horizonDistance(double radius) { return std::sqrt(std::max(radius * radius - kGroundRadius * kGroundRadius, 0.0)); }

struct Step {
  double middle, length;
};
/// The k-th of `count` steps along a path: short near its start, where the air is densest.
Step pathStep(int k, int count, double path) {
  const double from = double(k) / count, to = double(k + 1) / count;
  return {0.5 * (from * from + to * to) * path, (to * to - from * from) * path};
}

/// Light that a step of this length sends towards its start, by the light that is scattered per length.
Spectrum sentBy(const Atmosphere::Medium& air, double step, Spectrum& through) {
  Spectrum out;
  for (std::size_t b = 0; b < kBandCount; ++b) {
    const double passed = std::exp(-air.weakened[b] * step);
    out[b] = through[b] * (1 - passed) / std::max(air.weakened[b], 1e-12);
    through[b] *= passed;
  }
  return out;
}

Spectrum all(double value) {
  Spectrum out;
  out.fill(value);
  return out;
}

}  // namespace

Double3 sunColor(const Spectrum& shares) {
  Double3 out;
  for (std::size_t b = 0; b < kBandCount; ++b)
    for (std::size_t c = 0; c < 3; ++c) out[c] += kBands[b].sun[c] * shares[b];
  return out;
}

double Atmosphere::rayleighPhase(double cosine) { return 0.75 / kSphere * (1 + cosine * cosine); }

double Atmosphere::miePhase(double cosine) {
  constexpr double g = kMieAsymmetry;
  return 1.5 / kSphere * (1 - g * g) / (2 + g * g) * (1 + cosine * cosine) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

Atmosphere::Medium Atmosphere::medium(double height) const {
  const double molecules = std::exp(-height / kRayleighScale), aerosols = std::exp(-height / kMieScale);
  const double ozone = std::max(1 - std::abs(height - kOzoneHeight) / kOzoneWidth, 0.0);
  Medium out;
  for (std::size_t b = 0; b < kBandCount; ++b) {
    out.rayleigh[b] = rayleigh_[b] * molecules;
    out.mie[b] = mieScattering_[b] * aerosols;
    out.extinction[b] = out.rayleigh[b] + mieExtinction_[b] * aerosols + ozone_[b] * ozone;
    out.weakened[b] = out.extinction[b] - kAhead * out.mie[b];
  }
  return out;
}

Atmosphere::Atmosphere(double aerosolDepth, double groundAlbedo)
    : albedo_(groundAlbedo), transmittance_(96, 32), ahead_(96, 32), multiple_(24, 12) {
  for (std::size_t b = 0; b < kBandCount; ++b) {
    const double longer = kBands[b].nanometers / 550;
    rayleigh_[b] = kRayleigh * std::pow(longer, -4);
    mieExtinction_[b] = aerosolDepth / kMieScale * std::pow(longer, -kAngstrom);
    mieScattering_[b] = kMieAlbedo * mieExtinction_[b];
    ozone_[b] = kOzone * kBands[b].ozone;
  }
  fillTransmittance();
  for (int row = 0; row < multiple_.rows(); ++row)
    for (int column = 0; column < multiple_.columns(); ++column) {
      const double share = double(row) / (multiple_.rows() - 1), cosine = 2.0 * column / (multiple_.columns() - 1) - 1;
      multiple_.at(column, row) = scattered(share * share * kAirHeight, cosine);
    }
}

// The axes of Bruneton (2017): distance to the horizon, and distance to the top between its least and its largest.
void Atmosphere::fillTransmittance() {
  const double longest = horizonDistance(kAirTop);
  for (int row = 0; row < transmittance_.rows(); ++row) {
    const double horizon = longest * row / (transmittance_.rows() - 1);
    const double radius = std::sqrt(horizon * horizon + kGroundRadius * kGroundRadius), least = kAirTop - radius;
    for (int column = 0; column < transmittance_.columns(); ++column) {
      const double length = std::lerp(least, horizon + longest, double(column) / (transmittance_.columns() - 1));
      const double squares = longest * longest - horizon * horizon - length * length;
      const double cosine = length > 0 ? std::clamp(squares / (2 * radius * length), -1.0, 1.0) : 1;
      Spectrum depth = {}, weakened = {};
      for (int k = 0; k < kTransmittanceSteps; ++k) {
        const Step step = pathStep(k, kTransmittanceSteps, length);
        const Medium air = medium(radiusAfter(radius, cosine, step.middle) - kGroundRadius);
        for (std::size_t b = 0; b < kBandCount; ++b) {
          depth[b] += air.extinction[b] * step.length;
          weakened[b] += air.weakened[b] * step.length;
        }
      }
      for (std::size_t b = 0; b < kBandCount; ++b) {
        transmittance_.at(column, row)[b] = std::exp(-depth[b]);
        ahead_.at(column, row)[b] = std::exp(-weakened[b]);
      }
    }
  }
}

Spectrum Atmosphere::transmittance(double height, double cosine) const { return through(transmittance_, height, cosine); }

Spectrum Atmosphere::through(const Table<kBandCount>& table, double height, double cosine) const {
  const double radius = kGroundRadius + std::clamp(height, 0.0, kAirHeight);
  if (meetsGround(radius, cosine)) return all(0);
  const double horizon = horizonDistance(radius), longest = horizonDistance(kAirTop), least = kAirTop - radius;
  return table((distanceToTop(radius, cosine) - least) / (horizon + longest - least), horizon / longest);
}

Spectrum Atmosphere::multiple(double height, double sunCosine) const {
  return multiple_(0.5 + 0.5 * sunCosine, std::sqrt(std::clamp(height / kAirHeight, 0.0, 1.0)));
}

// Light that was scattered once by its paths, all further orders as a geometric series: section 5.5 of the paper.
Spectrum Atmosphere::scattered(double height, double sunCosine) const {
  const double radius = kGroundRadius + height, sunSine = std::sqrt(std::max(1 - sunCosine * sunCosine, 0.0));
  Spectrum once = {}, again = {};
  for (int k = 0; k < kTurns * kTilts; ++k) {
    const int tilt = k / kTurns;
    const double cosine = 1 - 2 * (tilt + 0.5) / kTilts, turn = kTurn * (k % kTurns + 0.5) / kTurns;
    const double apart = std::sqrt(1 - cosine * cosine) * std::cos(turn) * sunSine + cosine * sunCosine;
    const auto sunAt = [&](double distance, double at) { return (radius * sunCosine + distance * apart) / at; };
    const bool ground = meetsGround(radius, cosine);
    const double length = ground ? distanceToGround(radius, cosine) : distanceToTop(radius, cosine), step = length / kScatterSteps;
    Spectrum through = all(1);
    for (int s = 0; s < kScatterSteps; ++s) {
      const double distance = (s + 0.5) * step, at = radiusAfter(radius, cosine, distance);
      const Medium air = medium(at - kGroundRadius);
      const Spectrum sun = this->through(ahead_, at - kGroundRadius, sunAt(distance, at)), sent = sentBy(air, step, through);
      for (std::size_t b = 0; b < kBandCount; ++b) {
        const double part = sent[b] * (air.rayleigh[b] + (1 - kAhead) * air.mie[b]) / (kTurns * kTilts);
        again[b] += part;
        once[b] += part * sun[b] / kSphere;
      }
    }
    if (!ground) continue;
    const double sunUp = sunAt(length, kGroundRadius);
    const Spectrum sun = this->through(ahead_, 0, sunUp);
    for (std::size_t b = 0; b < kBandCount; ++b)
      once[b] += through[b] * albedo_ * std::numbers::inv_pi * std::max(sunUp, 0.0) * sun[b] / (kTurns * kTilts);
  }
  for (std::size_t b = 0; b < kBandCount; ++b) once[b] /= 1 - again[b];
  return once;
}

Atmosphere::Gathered Atmosphere::gather(double up, double sun, double apart) const {
  const double length = distanceToTop(kGroundRadius, up);
  Spectrum through = all(1);
  Gathered out = {};
  for (int k = 0; k < kGatherSteps; ++k) {
    const Step step = pathStep(k, kGatherSteps, length);
    const double at = radiusAfter(kGroundRadius, up, step.middle);
    const double height = at - kGroundRadius, sunCosine = (kGroundRadius * sun + step.middle * apart) / at;
    const Medium air = medium(height);
    const Spectrum direct = this->through(ahead_, height, sunCosine), indirect = multiple(height, sunCosine);
    const Spectrum sent = sentBy(air, step.length, through);
    for (std::size_t b = 0; b < kBandCount; ++b) {
      out.rayleigh[b] += sent[b] * air.rayleigh[b] * direct[b];
      out.mie[b] += sent[b] * air.mie[b] * direct[b];
      out.multiple[b] += sent[b] * (air.rayleigh[b] + (1 - kAhead) * air.mie[b]) * indirect[b];
    }
  }
  return out;
}

}  // namespace rill
