#version 460
// Exposure, then the AgX tone curve, whose values an sRGB display shows as they are.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "views/tone_curve.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D hdr;
layout(std430, set = 0, binding = 1) writeonly buffer Aliased { uint aliased[]; };
layout(push_constant) uniform Push { float gain; };

void main() {
  const ivec2 size = textureSize(hdr, 0);
  const uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  if (index >= uint(size.x) * uint(size.y)) return;
  const vec3 color = texelFetch(hdr, ivec2(index % uint(size.x), index / uint(size.x)), 0).rgb;
  const uvec3 bytes = uvec3(toneCurve(gain * bounded(color)) * 255.0 + 0.5);
  aliased[index] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
