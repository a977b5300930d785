#version 460
// The next coarser level of a layer of the map: means of four texels, in the layer of solids with the least depth.
#extension GL_GOOGLE_include_directive : require
#include "render/caustics_records.h"

layout(local_size_x = kCausticGroup) in;
layout(push_constant) uniform Push {
  uint from, from_width, from_height;  // first texel and size of the finer level
  uint to, to_width, to_height;
  uint solids;
};
layout(std430, set = 0, binding = 0) buffer Caustics { uvec2 caustics[]; };

vec4 texelAt(uint x, uint y) {
  const uvec2 packed = caustics[from + min(y, from_height - 1u) * from_width + min(x, from_width - 1u)];
  return vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y));
}

void main() {
  const uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kCausticGroup + gl_LocalInvocationIndex;
  if (index >= to_width * to_height) return;
  const uint x = 2u * (index % to_width), y = 2u * (index / to_width);
  const vec4 a = texelAt(x, y), b = texelAt(x + 1u, y), c = texelAt(x, y + 1u), d = texelAt(x + 1u, y + 1u);
  vec4 mean = 0.25 * (a + b + c + d);
  if (solids != 0u) mean.a = min(min(a.a, b.a), min(c.a, d.a));
  caustics[to + index] = uvec2(packHalf2x16(mean.rg), packHalf2x16(mean.ba));
}
