#version 460
// Exposure, then the AgX tone curve, whose values an sRGB display shows as they are.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "views/finish_records.h"
#include "views/tone_curve.glsl"

layout(local_size_x = kPictureTile, local_size_y = kPictureTile) in;
layout(set = 0, binding = 0) uniform texture2D hdr;
layout(std430, set = 0, binding = 1) writeonly buffer Aliased { uint aliased[]; };
layout(push_constant) uniform Push { float gain; };

void main() {
  const ivec2 size = textureSize(hdr, 0);
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  const vec3 color = texelFetch(hdr, pixel, 0).rgb;
  const uvec3 bytes = uvec3(toneCurve(gain * bounded(color)) * 255.0 + 0.5);
  aliased[uint(pixel.y) * uint(size.x) + uint(pixel.x)] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
