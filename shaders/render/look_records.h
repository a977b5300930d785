// The appearance of a fluid, as shaders read it. Colors are linear RGB; directions are in world space.
#ifndef RILL_RENDER_LOOK_RECORDS_H
#define RILL_RENDER_LOOK_RECORDS_H

#ifdef __cplusplus
#include <cstdint>

#include "rill/vectors.hpp"
namespace rill::look {
using uint = std::uint32_t;
using vec4 = Float4;
#endif

#ifdef __cplusplus
constexpr uint kMaxLookFluids = 8;
#else
const uint kMaxLookFluids = 8u;
#endif

struct LookRecord {
  vec4 absorption;  // 1/m; w: index of refraction
  vec4 scatter;     // color of white light scattered by thick fluid; w: 1 if the fluid is opaque
  vec4 light;       // direction to the sun; w: radiance of its reflection relative to `sunlight`
  // x: exponent of the sun's highlight, y: pixels per sample of the thickness buffer, z: m per count
  // of it, w: strength of whitewater
  vec4 finish;
  vec4 above;       // irradiance of the environment from above, over pi; w: width in texels, 0: no environment
  vec4 below;       // the same from below; w: height
  vec4 emission;    // radiance of thick fluid of its own
  vec4 sunlight;    // of an environment: radiance of a white surface that faces the sun; w: radius of its disc in rad, 0: none
  vec4 scattering;  // 1/m, of the sun's light in the fluid; w: mean cosine
  vec4 crests;      // x: cells a side of the grid across the sun's rays
  // Of each of several fluids: absorption in 1/m, w: 1 if `emission` and `scattering` are its own, 0 if it has none; color as `scatter`
  vec4 fluid_absorption[kMaxLookFluids];
  vec4 fluid_scatter[kMaxLookFluids];
};

#ifdef __cplusplus
}  // namespace rill::look
#endif
#endif
