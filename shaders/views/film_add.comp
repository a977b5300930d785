#version 460
// Adds a picture in linear light to a sum of pictures, or begins a sum with it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "views/tone_curve.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D hdr;
layout(std430, set = 0, binding = 1) buffer Sum { vec4 sum[]; };
layout(push_constant) uniform Push { uint first; };

void main() {
  const ivec2 size = textureSize(hdr, 0);
  const uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  if (index >= uint(size.x) * uint(size.y)) return;
  const vec3 color = bounded(texelFetch(hdr, ivec2(index % uint(size.x), index / uint(size.x)), 0).rgb);
  sum[index] = vec4(first != 0u ? color : sum[index].rgb + color, 1.0);
}
