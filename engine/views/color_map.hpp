#pragma once
#include <cstdint>

#include "rill/float3.hpp"

namespace rill {

/// What a particle's color says.
enum class ParticleColor : uint8_t {
  Speed,       ///< m/s, from rest (dark blue) to fast (nearly white)
  Compression  ///< density over rest density - 1, from none (pale) to much (dark purple)
};

/// Linear RGB of a value `t` in 0 .. 1 (clamped). Lightness is linear in `t` (Oklab), so the maps read the same in gray and to a
/// color-blind eye.
Float3 mapColor(ParticleColor color, double t);

/// A linear component in 0 .. 1 (clamped) as an sRGB byte.
uint8_t srgbByte(double linear);

}  // namespace rill
