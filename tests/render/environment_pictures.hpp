#pragma once
// Environment maps to test with, and sums over them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "render/environment.hpp"

namespace rill::test {
namespace environment_test {

using Rgb = std::array<double, 3>;

inline Rgb unpacked(uint32_t texel) {
  const double scale = std::ldexp(1.0, int(texel >> 27) - 24);
  return {(texel & 511) * scale, (texel >> 9 & 511) * scale, (texel >> 18 & 511) * scale};
}

/// `color` of (column, row).
inline EnvironmentPicture picture(uint32_t width, const std::function<Rgb(uint32_t, uint32_t)>& color) {
  EnvironmentPicture out{width, width / 2, {}};
  for (uint32_t y = 0; y < out.height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const Rgb c = color(x, y);
      out.texels.push_back(sharedExponent(float(c[0]), float(c[1]), float(c[2])));
    }
  return out;
}

inline double dotOf(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Double3 directionOf(double x, double y, uint32_t width) {
  const double polar = 2 * y / width * std::numbers::pi, turn = (x / width - 0.5) * 2 * std::numbers::pi;
  return {std::sin(polar) * std::sin(turn), std::cos(polar), -std::sin(polar) * std::cos(turn)};
}

inline double solidAngle(uint32_t y, uint32_t width) {
  const double step = 2 * std::numbers::pi / width;
  return 2 * std::numbers::pi / width * (std::cos(y * step) - std::cos((y + 1) * step));
}

/// Irradiance of each channel on a surface with this normal.
inline Rgb irradianceOf(const EnvironmentPicture& map, const Double3& normal) {
  Rgb sum{};
  for (uint32_t y = 0; y < map.height; ++y)
    for (uint32_t x = 0; x < map.width; ++x) {
      const double weight = solidAngle(y, map.width) * std::max(dotOf(directionOf(x + 0.5, y + 0.5, map.width), normal), 0.0);
      const Rgb color = unpacked(map.texels[y * map.width + x]);
      for (size_t c = 0; c < 3; ++c) sum[c] += weight * color[c];
    }
  return sum;
}

/// A blue sky over gray ground, with a disc of `radius` rad towards `sun`.
inline EnvironmentPicture sunny(const Double3& sun, double radius, double radiance, uint32_t width = 512) {
  return picture(width, [&](uint32_t x, uint32_t y) {
    const bool disc = dotOf(directionOf(x + 0.5, y + 0.5, width), sun) > std::cos(radius);
    if (disc) return Rgb{radiance, 0.9 * radiance, 0.7 * radiance};
    return y < width / 4 ? Rgb{0.2, 0.4, 0.9} : Rgb{0.2, 0.2, 0.2};
  });
}

inline constexpr double kTexel = std::numbers::pi / 256;  // rad, of a map of 512 x 256

}  // namespace environment_test
}  // namespace rill::test
