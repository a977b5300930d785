// Clear skies of Preetham, Shirley and Smits, "A Practical Analytic Model for Daylight" (SIGGRAPH 1999): the sky's radiance after Perez et
// al. with coefficients by turbidity, and the sun's after the air's extinction (their appendix).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/look_names.hpp"
#include "render/environment_texels.hpp"
#include "rill/environment.hpp"

namespace rill {
namespace {

constexpr uint32_t kSkyRows = 512;
constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;
// Twice as wide as the sun's, with a fourth of its radiance, which a texel can hold.
constexpr double kSunRadius = 2 * 0.2666 * kDegree;
constexpr double kSunLux = 128e3;                        // of the sun outside the atmosphere
constexpr Double3 kSunColor = {1.06, 0.99, 0.94};        // the same, linear RGB
constexpr Double3 kWavelengths = {0.610, 0.550, 0.465};  // of the channels, micrometers
constexpr Double3 kGroundAlbedo = {0.115, 0.13, 0.15};   // of scenery_ground.frag, so that the stage has no rim

constexpr double kSkyHaze = 0.02;  // rad below the horizon where the ground has most of the color of the sky over it

struct Sky {
  std::string_view name;
  Double3 toSun;     // of any length
  double turbidity;  // 2: very clear, 6: hazy
};
constexpr std::string_view kStudio = "studio";
constexpr Sky kSkies[] = {{"day", {-0.36, 1.0, 0.52}, 2.0}, {"sunset", {-0.75, 0.16, -0.66}, 3.5}};
static_assert(kSkyNames == std::array{kStudio, kSkies[0].name, kSkies[1].name});

/// The distribution of Perez et al.: `polar` from the zenith and `apart` from the sun, rad.
struct Perez {
  double a, b, c, d, e;
  double operator()(double polar, double apart) const {
    const double cosine = std::cos(apart);
    return (1 + a * std::exp(b / std::max(std::cos(polar), 0.01))) * (1 + c * std::exp(d * apart) + e * cosine * cosine);
  }
};

class ClearSky {
 public:
  ClearSky(const Double3& sun, double turbidity) : sun_(sun), t_(turbidity), sunPolar_(std::acos(sun.y)) {
    const double t = turbidity, s = sunPolar_;
    const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * s);
    zenith_[0] = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const auto cubic = [s](double k3, double k2, double k1, double k0) { return ((k3 * s + k2) * s + k1) * s + k0; };
    zenith_[1] = t * t * cubic(0.00166, -0.00375, 0.00209, 0) + t * cubic(-0.02903, 0.06377, -0.03202, 0.00394) +
                 cubic(0.11693, -0.21196, 0.06052, 0.25886);
    zenith_[2] = t * t * cubic(0.00275, -0.00610, 0.00317, 0) + t * cubic(-0.04214, 0.08970, -0.04153, 0.00516) +
                 cubic(0.15346, -0.26756, 0.06670, 0.26688);
    perez_[0] = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
    perez_[1] = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
    perez_[2] = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
    for (int k = 0; k < 3; ++k) zenith_[k] /= perez_[k](0, sunPolar_);
  }

  /// Radiance of the sky in linear RGB; a luminance of 1000 cd/m2 is 1. `direction`: a unit vector above the horizon.
  Double3 radiance(const Double3& direction) const {
    const double polar = std::acos(std::clamp(direction.y, 0.0, 1.0));
    const double apart = std::acos(std::clamp(direction.x * sun_.x + direction.y * sun_.y + direction.z * sun_.z, -1.0, 1.0));
    const double lum = zenith_[0] * perez_[0](polar, apart), x = zenith_[1] * perez_[1](polar, apart);
    const double y = zenith_[2] * perez_[2](polar, apart), cx = lum * x / y, cz = lum * (1 - x - y) / y;
    return {std::max(3.2406 * cx - 1.5372 * lum - 0.4986 * cz, 0.0), std::max(-0.9689 * cx + 1.8758 * lum + 0.0415 * cz, 0.0),
            std::max(0.0557 * cx - 0.2040 * lum + 1.0570 * cz, 0.0)};
  }

  /// Irradiance of a surface that faces the sun, over the unit of radiance().
  Double3 sunIrradiance() const {
    const double mass = 1 / (std::cos(sunPolar_) + 0.15 * std::pow(93.885 - sunPolar_ / kDegree, -1.253));
    const double haze = 0.04608 * t_ - 0.04586;
    Double3 out;
    for (int c = 0; c < 3; ++c) {
      const double rayleigh = 0.008735 * std::pow(kWavelengths[c], -4.08), aerosol = haze * std::pow(kWavelengths[c], -1.3);
      out[c] = kSunLux / 1000 * kSunColor[c] * std::exp(-(rayleigh + aerosol) * mass);
    }
    return out;
  }

 private:
  Double3 sun_;
  double t_, sunPolar_;
  Double3 zenith_ = {0, 0, 0};
  std::array<Perez, 3> perez_ = {};
};

/// How much of a texel the sun's disc covers.
double covered(uint32_t x, uint32_t y, const Double3& sun) {
  constexpr int kSamples = 8;
  const double edge = std::cos(kSunRadius);
  int inside = 0;
  for (int v = 0; v < kSamples; ++v)
    for (int u = 0; u < kSamples; ++u) {
      const Double3 d = mapDirection(x + (u + 0.5) / kSamples, y + (v + 0.5) / kSamples, 2 * kSkyRows, kSkyRows);
      inside += d.x * sun.x + d.y * sun.y + d.z * sun.z > edge;
    }
  return double(inside) / (kSamples * kSamples);
}

}  // namespace

std::span<const std::string_view> skies() { return kSkyNames; }

std::optional<EnvironmentPicture> skyPicture(std::string_view name) {
  const auto* found = std::ranges::find(kSkies, name, &Sky::name);
  if (found == std::end(kSkies)) return std::nullopt;
  const Double3& to = found->toSun;
  const double size = std::sqrt(to.x * to.x + to.y * to.y + to.z * to.z);
  const Double3 sun = {to.x / size, to.y / size, to.z / size};
  const ClearSky sky(sun, found->turbidity);
  constexpr uint32_t rows = kSkyRows, columns = 2 * rows;
  std::vector<Double3> colors(size_t{rows / 2} * columns);
  const Double3 direct = sky.sunIrradiance();
  Double3 level = {direct.x * sun.y, direct.y * sun.y, direct.z * sun.y};  // irradiance of the ground
  for (uint32_t y = 0; y < rows / 2; ++y)
    for (uint32_t x = 0; x < columns; ++x) {
      const Double3 direction = mapDirection(x + 0.5, y + 0.5, columns, rows), color = sky.radiance(direction);
      colors[size_t{y} * columns + x] = color;
      for (int c = 0; c < 3; ++c) level[c] += color[c] * direction.y * texelSolidAngle(y, columns, rows);
    }
  // White ground has the radiance 1, as a camera would expose it.
  const double scale = kPi / luminance(level), disc = 2 * kPi * (1 - std::cos(kSunRadius));
  EnvironmentPicture out{columns, rows, {}};
  out.texels.reserve(size_t{rows} * columns);
  for (uint32_t y = 0; y < rows; ++y)
    for (uint32_t x = 0; x < columns; ++x) {
      Double3 color;
      if (y < rows / 2) {
        color = colors[size_t{y} * columns + x];
        const Double3 d = mapDirection(x + 0.5, y + 0.5, columns, rows);
        const bool near = d.x * sun.x + d.y * sun.y + d.z * sun.z > std::cos(kSunRadius + 2 * kPi / rows);
        const double part = near ? covered(x, y, sun) / disc : 0;
        for (int c = 0; c < 3; ++c) color[c] += part * direct[c];
      } else {
        const Double3& horizon = colors[size_t{rows / 2 - 1} * columns + x];
        const double hazy = std::exp(std::cos((y + 0.5) / rows * kPi) / kSkyHaze);
        for (int c = 0; c < 3; ++c) color[c] = std::lerp(kGroundAlbedo[c] * level[c] / kPi, horizon[c], hazy);
      }
      out.texels.push_back(
          sharedExponent(static_cast<float>(scale * color.x), static_cast<float>(scale * color.y), static_cast<float>(scale * color.z)));
    }
  return out;
}

}  // namespace rill
