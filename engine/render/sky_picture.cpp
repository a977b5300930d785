// Clear skies as environment maps: the light that an atmosphere scatters, the sun's disc, and a sea to the horizon.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/look_names.hpp"
#include "core/vector_math.hpp"
#include "render/atmosphere.hpp"
#include "render/environment_texels.hpp"
#include "rill/environment.hpp"

namespace rill {
namespace {

constexpr uint32_t kSkyRows = 512;
constexpr double kPi = std::numbers::pi;
// Twice as wide as the sun's, with a fourth of its radiance, which a texel can hold.
constexpr double kSunRadius = 2 * 0.2666 * kPi / 180;
// A camera's balance for daylight: the color of white ground by day, which would look yellow and the horizon pink without.
constexpr Double3 kDaylight = {1.119, 0.981, 0.880};
constexpr double kSeaAlbedo = 0.08;
constexpr Double3 kSeaColor = {0.004, 0.016, 0.030};  // of clear water: diffuse reflectance
constexpr double kSlopes = 0.0235;                    // their variance, along both axes together: a wind of 4 m/s (Cox and Munk 1954)

struct Sky {
  std::string_view name;
  Double3 toSun;  // of any length
  double aerosolDepth;
  double white;  // luminance of white ground
};
constexpr std::string_view kStudio = "studio";
constexpr Sky kSkies[] = {{"day", {-0.85, 0.75, 0.40}, 0.06, 1.9}, {"sunset", {-0.90, 0.14, -0.35}, 0.10, 0.35}};
static_assert(kSkyNames == std::array{kStudio, kSkies[0].name, kSkies[1].name});

/// Radiance of the sky seen from the ground. Without phase functions, which peak at the sun, it is smooth: few rays are enough.
class ClearSky {
 public:
  ClearSky(const Atmosphere& air, const Double3& sun) : sun_(sun) {
    const double sine = std::sqrt(1 - sun.y * sun.y);
    for (int row = 0; row < light_.rows(); ++row)
      for (int column = 0; column < light_.columns(); ++column) {
        const double share = double(row) / (light_.rows() - 1), polar = kPi / 2 * (1 - share * share);
        const double turn = kPi * column / (light_.columns() - 1), up = std::cos(polar);
        const auto gathered = air.gather(up, sun.y, up * sun.y + std::sin(polar) * sine * std::cos(turn));
        const Double3 colors[] = {sunColor(gathered.rayleigh), sunColor(gathered.mie), sunColor(gathered.multiple)};
        for (size_t k = 0; k < 9; ++k) light_.at(column, row)[k] = colors[k / 3][k % 3];
      }
  }

  /// Towards a unit vector above the horizon.
  Double3 radiance(const Double3& to) const {
    const double across = std::hypot(to.x, to.z) * std::hypot(sun_.x, sun_.z);
    const double turn = across > 0 ? std::acos(std::clamp((to.x * sun_.x + to.z * sun_.z) / across, -1.0, 1.0)) : 0;
    const double polar = std::acos(std::clamp(to.y, 0.0, 1.0)), apart = to.x * sun_.x + to.y * sun_.y + to.z * sun_.z;
    const double molecules = Atmosphere::rayleighPhase(apart), aerosols = Atmosphere::miePhase(apart);
    const auto light = light_(turn / kPi, std::sqrt(1 - polar / (kPi / 2)));
    Double3 out;
    for (size_t c = 0; c < 3; ++c) out[c] = molecules * light[c] + aerosols * light[3 + c] + light[6 + c];
    return out;
  }

 private:
  Double3 sun_;
  // By azimuth from the sun and by elevation: RGB of light scattered once by molecules, once by aerosols, and more often.
  Table<9> light_{17, 64};
};

/// Radiance of a sea below the horizon, whose waves are too small to be seen. Their slopes are normally distributed.
class Sea {
 public:
  /// `direct`: irradiance of a surface that faces the sun; `level`: of the sea.
  Sea(const ClearSky& sky, const Double3& sun, const Double3& direct, const Double3& level)
      : sun_(sun), azimuth_(std::atan2(sun.z, sun.x)), direct_(direct), level_(level) {
    for (int row = 0; row < mirrored_.rows(); ++row)
      for (int column = 0; column < mirrored_.columns(); ++column) {
        const double share = double(row) / (mirrored_.rows() - 1), up = std::sin(kPi / 2 * share * share);
        const double turn = azimuth_ + kPi * column / (mirrored_.columns() - 1), across = std::sqrt(1 - up * up);
        mirrored_.at(column, row) = reflected(sky, {across * std::cos(turn), up, across * std::sin(turn)});
      }
  }

  /// Towards a unit vector below the horizon.
  Double3 radiance(const Double3& to) const {
    const double turn = std::abs(std::remainder(std::atan2(to.z, to.x) - azimuth_, 2 * kPi)), down = std::asin(std::clamp(-to.y, 0.0, 1.0));
    const auto light = mirrored_(turn / kPi, std::sqrt(down / (kPi / 2)));
    // The slopes that mirror the sun
    const Double3 between = normalized(minus(sun_, to));
    const double square = (between.x * between.x + between.z * between.z) / (between.y * between.y);
    const double density = std::exp(-square / kSlopes) / (kPi * kSlopes);
    const double glint = fresnel(-dot(between, to)) * density / (4 * light[3] * std::pow(between.y, 4));
    Double3 out;
    for (size_t c = 0; c < 3; ++c) out[c] = light[c] + glint * direct_[c] + kSeaColor[c] * level_[c] / kPi;
    return out;
  }

 private:
  static double fresnel(double cosine) { return 0.02 + 0.98 * std::pow(1 - std::clamp(cosine, 0.0, 1.0), 5); }

  /// Of the sky, and the area of the waves that is seen over that of the sea, from below the horizon on the other side of `eye`, where the
  /// sky of that azimuth is mirrored.
  static std::array<double, 4> reflected(const ClearSky& sky, const Double3& ahead) {
    const Double3 eye = {-ahead.x, ahead.y, -ahead.z};
    std::array<double, 4> out = {};
    double shares = 0;
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i) {
        const double share = std::exp(-0.5 * (i * i + j * j)), deviation = std::sqrt(kSlopes / 2);
        const Double3 normal = normalized({i * deviation, 1, j * deviation});
        const double cosine = dot(normal, eye), seen = share * std::max(cosine, 0.0) / normal.y;
        shares += share;
        if (!(seen > 0)) continue;
        const Double3 to = {2 * cosine * normal.x - eye.x, std::abs(2 * cosine * normal.y - eye.y), 2 * cosine * normal.z - eye.z};
        const Double3 light = sky.radiance(to);
        for (size_t c = 0; c < 3; ++c) out[c] += seen * fresnel(cosine) * light[c];
        out[3] += seen;
      }
    for (size_t c = 0; c < 3; ++c) out[c] /= out[3];
    out[3] /= shares;
    return out;
  }

  Double3 sun_;
  double azimuth_;
  Double3 direct_, level_;
  Table<4> mirrored_{25, 48};  // by azimuth from the sun and by angle below the horizon
};

/// How much of a texel the sun's disc covers.
double covered(uint32_t x, uint32_t y, const Double3& sun) {
  constexpr int kSamples = 8;
  const double edge = std::cos(kSunRadius);
  int inside = 0;
  for (int v = 0; v < kSamples; ++v)
    for (int u = 0; u < kSamples; ++u) {
      const Double3 d = mapDirection(x + (u + 0.5) / kSamples, y + (v + 0.5) / kSamples, 2 * kSkyRows, kSkyRows);
      inside += dot(d, sun) > edge;
    }
  return double(inside) / (kSamples * kSamples);
}

}  // namespace

std::span<const std::string_view> skies() { return kSkyNames; }

std::optional<EnvironmentPicture> skyPicture(std::string_view name) {
  const auto* found = std::ranges::find(kSkies, name, &Sky::name);
  if (found == std::end(kSkies)) return std::nullopt;
  const Double3 sun = normalized(found->toSun);
  const Atmosphere air(found->aerosolDepth, kSeaAlbedo);
  const ClearSky sky(air, sun);
  constexpr uint32_t rows = kSkyRows, columns = 2 * rows;
  std::vector<Double3> colors(size_t{rows / 2} * columns);
  const Double3 direct = sunColor(air.transmittance(0, sun.y));
  Double3 level = {direct.x * sun.y, direct.y * sun.y, direct.z * sun.y};  // irradiance of the ground
  for (uint32_t y = 0; y < rows / 2; ++y)
    for (uint32_t x = 0; x < columns; ++x) {
      const Double3 direction = mapDirection(x + 0.5, y + 0.5, columns, rows), color = sky.radiance(direction);
      colors[size_t{y} * columns + x] = color;
      for (int c = 0; c < 3; ++c) level[c] += color[c] * direction.y * texelSolidAngle(y, columns, rows);
    }
  const Sea sea(sky, sun, direct, level);
  const double exposure = found->white * kPi / luminance(level), disc = 2 * kPi * (1 - std::cos(kSunRadius));
  const Double3 scale = {exposure / kDaylight.x, exposure / kDaylight.y, exposure / kDaylight.z};
  EnvironmentPicture out{columns, rows, {}};
  out.texels.reserve(size_t{rows} * columns);
  for (uint32_t y = 0; y < rows; ++y)
    for (uint32_t x = 0; x < columns; ++x) {
      Double3 color;
      if (y < rows / 2) {
        color = colors[size_t{y} * columns + x];
        const Double3 d = mapDirection(x + 0.5, y + 0.5, columns, rows);
        const bool near = dot(d, sun) > std::cos(kSunRadius + 2 * kPi / rows);
        const double part = near ? covered(x, y, sun) / disc : 0;
        for (int c = 0; c < 3; ++c) color[c] += part * direct[c];
      } else {
        color = sea.radiance(mapDirection(x + 0.5, y + 0.5, columns, rows));
      }
      out.texels.push_back(sharedExponent(static_cast<float>(scale.x * color.x), static_cast<float>(scale.y * color.y),
                                          static_cast<float>(scale.z * color.z)));
    }
  return out;
}

}  // namespace rill
