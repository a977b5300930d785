#pragma once
#include <cstddef>
#include <cstdint>

#include "rill/vectors.hpp"

namespace rill {

/// The quantity that a particle's color shows.
enum class ParticleColor : uint8_t {
  Speed,        ///< m/s, from rest (dark blue) to fast (nearly white)
  Compression,  ///< density over rest density - 1, from none (pale) to much (dark purple)
  Fluid         ///< which of several fluids; no map
};

/// Linear RGB of a value `t` in 0 .. 1 (clamped). Lightness is linear in `t` (Oklab), which keeps the maps readable in gray and with
/// color blindness.
Float3 mapColor(ParticleColor color, double t);

/// Linear RGB of the fluid of this index where the scene gives it none. Eight colors that are told apart with color blindness (after Okabe
/// and Ito 2008); they repeat.
Float3 fluidColor(size_t index);

/// A linear component in 0 .. 1 (clamped) as an sRGB byte.
uint8_t srgbByte(double linear);

}  // namespace rill
