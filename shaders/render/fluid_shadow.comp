#version 460
// Thickness of each fluid towards the light, m: of a texel the mean over three by three, because the disc of the sun blurs edges. A border
// of kShadowBorder texels, most of it 0, spares readers a test.
#extension GL_GOOGLE_include_directive : require
#include "render/surface_records.h"

layout(local_size_x = kSurfaceTile, local_size_y = kSurfaceTile) in;
layout(push_constant) uniform Push { FluidShadowPush push; };
layout(std430, set = 0, binding = 0) readonly buffer Thickness { uint thickness[]; };
layout(std430, set = 0, binding = 1) writeonly buffer FluidShadow { float fluid_shadow[]; };

void main() {
  const ivec2 size = ivec2(push.width, push.height), bordered = size + 2 * int(kShadowBorder), at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, bordered))) return;
  const uint fluid = gl_GlobalInvocationID.z;
  const ivec2 middle = at - int(kShadowBorder), first = max(middle - 1, ivec2(0)), last = min(middle + 1, size - 1);
  float sum = 0.0;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) sum += float(thickness[(fluid * uint(size.y) + uint(y)) * uint(size.x) + uint(x)]);
  fluid_shadow[(fluid * uint(bordered.y) + uint(at.y)) * uint(bordered.x) + uint(at.x)] = sum * push.unit / 9.0;
}
