#pragma once
#include <cstdint>

#include "rill/vectors.hpp"

namespace rill {

/// The quantity that a particle's color shows.
enum class ParticleColor : uint8_t {
  Speed,       ///< m/s, from rest (dark blue) to fast (nearly white)
  Compression  ///< density over rest density - 1, from none (pale) to much (dark purple)
};

/// Linear RGB of a value `t` in 0 .. 1 (clamped). Lightness is linear in `t` (Oklab), which keeps the maps readable in gray and with
/// color blindness.
Float3 mapColor(ParticleColor color, double t);

/// A linear component in 0 .. 1 (clamped) as an sRGB byte.
uint8_t srgbByte(double linear);

}  // namespace rill
