#version 460
// The mean of summed pictures: with exposure and tone curve as RGBA8, with LINEAR as it is, in half floats.
#extension GL_GOOGLE_include_directive : require
#include "views/tone_curve.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Sum { vec4 sum[]; };
#ifdef LINEAR
layout(std430, set = 0, binding = 1) writeonly buffer Picture { uvec2 picture[]; };
#else
layout(std430, set = 0, binding = 1) writeonly buffer Picture { uint picture[]; };
#endif
layout(push_constant) uniform Push { uint pixels; float gain; };  // gain: of the sum

void main() {
  const uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  if (index >= pixels) return;
  const vec3 color = bounded(gain * sum[index].rgb);
#ifdef LINEAR
  picture[index] = uvec2(packHalf2x16(color.rg), packHalf2x16(vec2(color.b, 1.0)));
#else
  const uvec3 bytes = uvec3(toneCurve(color) * 255.0 + 0.5);
  picture[index] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
#endif
}
