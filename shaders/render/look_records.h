// How a fluid looks, as shaders read it. Colors are linear RGB; directions are in the world.
#ifndef RILL_RENDER_LOOK_RECORDS_H
#define RILL_RENDER_LOOK_RECORDS_H

#ifdef __cplusplus
#include <cstdint>

#include "rill/float3.hpp"
namespace rill::look {
using uint = std::uint32_t;
using vec4 = Float4;
#endif

struct LookRecord {
  vec4 absorption;  // 1/m; w: index of refraction
  vec4 scatter;     // what the fluid's inside sends back where it is thick; w: 1 where it is opaque
  vec4 light;       // direction to the sun; w: its radiance over the sky's
  // x: exponent of the sun's highlight, y: pixels a side of the thickness buffer's samples, z: m of
  // its counts, w: how white torn fluid is
  vec4 finish;
  vec4 above;       // light of the environment on what looks up; w: its width in texels, 0: there is none
  vec4 below;       // and on what looks down; w: its height
};

#ifdef __cplusplus
}  // namespace rill::look
#endif
#endif
