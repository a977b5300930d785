#pragma once
// Texels of environment maps: their colors, directions and solid angles.
#include <cmath>
#include <cstdint>
#include <numbers>

#include "rill/environment.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// Linear RGB of a texel that sharedExponent() packed.
inline Double3 unpackTexel(uint32_t texel) {
  const double scale = std::ldexp(1.0, static_cast<int>(texel >> 27) - 24);
  return {scale * (texel & 0x1FFu), scale * ((texel >> 9) & 0x1FFu), scale * ((texel >> 18) & 0x1FFu)};
}

/// Relative luminance of linear RGB (ITU-R BT.709).
inline double luminance(const Double3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// Solid angle of a texel of row `y`, sr.
inline double texelSolidAngle(uint32_t y, uint32_t width, uint32_t height) {
  const double step = std::numbers::pi / height;
  return 2 * std::numbers::pi / width * (std::cos(y * step) - std::cos((y + 1) * step));
}

/// Unit vector towards the point (x, y) of the map, in texels from its upper left corner.
inline Double3 mapDirection(double x, double y, uint32_t width, uint32_t height) {
  const double polar = y / height * std::numbers::pi, turn = (x / width - 0.5) * 2 * std::numbers::pi;
  return {std::sin(polar) * std::sin(turn), std::cos(polar), -std::sin(polar) * std::cos(turn)};
}

}  // namespace rill
