#version 460
// Tone curve (Khronos PBR Neutral) and sRGB encoding: values below 0.8 are offset by up to 0.04, above it compressed towards white.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "views/srgb.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D hdr;
layout(std430, set = 0, binding = 1) writeonly buffer Aliased { uint aliased[]; };

// Negative values and NaNs become 0 (by bits, because a compiler may assume that there are no NaNs), infinity the largest half.
vec3 bounded(vec3 c) {
  return min(mix(vec3(0.0), c, lessThanEqual(floatBitsToUint(c), uvec3(0x7F800000u))), 65504.0);
}

vec3 neutral(vec3 c) {
  const float start = 0.8 - 0.04, desaturation = 0.15;
  const float low = min(c.r, min(c.g, c.b));
  const float offset = low < 0.08 ? low - 6.25 * low * low : 0.04;
  c -= offset;
  const float peak = max(c.r, max(c.g, c.b));
  if (peak < start) return c;
  const float d = 1.0 - start;
  const float compressed = 1.0 - d * d / (peak + d - start);
  c *= compressed / peak;
  return mix(c, vec3(compressed), 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0));
}

void main() {
  const ivec2 size = textureSize(hdr, 0);
  const uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  if (index >= uint(size.x) * uint(size.y)) return;
  const vec3 color = texelFetch(hdr, ivec2(index % uint(size.x), index / uint(size.x)), 0).rgb;
  aliased[index] = encodeSrgb(neutral(bounded(color)));
}
