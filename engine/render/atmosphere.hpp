#pragma once
// Light of the sun in a clear atmosphere: Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" (EGSR 2020),
// in nine bands of wavelengths in place of three, which would tint the horizon. Lengths are in kilometers. All radiance is that of a sun
// whose irradiance outside the atmosphere is 1 in each band.
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "rill/vectors.hpp"

namespace rill {

inline constexpr double kGroundRadius = 6360, kAirTop = 6460;  // from the center of the Earth

struct Band {
  double nanometers, ozone;  // the latter: cross section, 1e-25 m2
  Double3 sun;               // of the sun's light outside the atmosphere in linear RGB; the sum has the luminance 1
};
// Means over 365 to 430, by 30 to 640, and to 780 nm, weighted by the CIE 1931 observer (fit of Wyman, Sloan and Shirley 2013) and by the
// sun. Spectrum of the sun: ASTM G173; of ozone: Serdyuchenko et al. (2014), 233 K; both as listed by Bruneton (2017).
inline constexpr std::array<Band, 9> kBands = {{{420, 0.05, {0.0217, -0.0188, 0.1387}},
                                                {445, 0.17, {0.0514, -0.0564, 0.5174}},
                                                {471, 0.48, {-0.0675, 0.0347, 0.3474}},
                                                {504, 1.34, {-0.2032, 0.2250, 0.0491}},
                                                {535, 2.69, {-0.1915, 0.4189, -0.0375}},
                                                {565, 4.13, {0.2010, 0.3259, -0.0440}},
                                                {594, 4.68, {0.6074, 0.0916, -0.0238}},
                                                {622, 3.91, {0.5043, -0.0300, -0.0065}},
                                                {654, 2.31, {0.1721, -0.0132, -0.0018}}}};
inline constexpr std::size_t kBandCount = kBands.size();
using Spectrum = std::array<double, kBandCount>;

/// What sunlight with these shares of its bands looks like.
Double3 sunColor(const Spectrum& shares);

/// Of N numbers, bilinear over the unit square.
template <std::size_t N>
class Table {
 public:
  using Cell = std::array<double, N>;
  Table(int columns, int rows) : columns_(columns), rows_(rows), cells_(std::size_t(columns) * std::size_t(rows)) {}
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  Cell& at(int column, int row) { return cells_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)]; }

  Cell operator()(double u, double v) const {
    const double x = std::clamp(u, 0.0, 1.0) * (columns_ - 1), y = std::clamp(v, 0.0, 1.0) * (rows_ - 1);
    const int left = std::min(int(x), columns_ - 2), low = std::min(int(y), rows_ - 2);
    const double right = x - left, up = y - low;
    const Cell* below = &cells_[std::size_t(low) * std::size_t(columns_) + std::size_t(left)];
    const Cell* above = below + columns_;
    Cell out;
    for (std::size_t k = 0; k < N; ++k)
      out[k] = (1 - up) * ((1 - right) * below[0][k] + right * below[1][k]) + up * ((1 - right) * above[0][k] + right * above[1][k]);
    return out;
  }

 private:
  int columns_, rows_;
  std::vector<Cell> cells_;
};

class Atmosphere {
 public:
  /// `aerosolDepth`: optical depth of aerosols along the vertical at 550 nm, 0.02 (very clear) to 0.4 (hazy).
  Atmosphere(double aerosolDepth, double groundAlbedo);

  struct Medium {
    Spectrum rayleigh, mie, extinction;  // 1/km; the first two scatter
    Spectrum weakened;                   // extinction without what aerosols scatter straight ahead
  };
  Medium medium(double height) const;

  /// Of the light that comes from outside to a point `height` above the ground, at an angle with this cosine to the vertical.
  Spectrum transmittance(double height, double cosine) const;

  /// Mean radiance over all directions of light that was scattered at least once, at a height and a cosine of the sun's angle.
  Spectrum multiple(double height, double sunCosine) const;

  /// What reaches an eye on the ground of light scattered once by molecules and once by aerosols, both without their phase functions, and
  /// of light scattered more often. Light that aerosols have also scattered straight ahead counts as scattered once.
  struct Gathered {
    Spectrum rayleigh, mie, multiple;
  };
  /// `up` (0 to 1) and `sun`: cosines to the vertical of the ray and of the sun; `apart`: between the two.
  Gathered gather(double up, double sun, double apart) const;

  static double rayleighPhase(double cosine);
  static double miePhase(double cosine);  // of Cornette and Shanks

 private:
  void fillTransmittance();
  Spectrum through(const Table<kBandCount>& table, double height, double cosine) const;
  Spectrum scattered(double height, double sunCosine) const;

  Spectrum rayleigh_, mieScattering_, mieExtinction_, ozone_;  // 1/km where each is densest
  double albedo_;
  Table<kBandCount> transmittance_, ahead_, multiple_;  // the second with `weakened`
};

}  // namespace rill
