#version 460
#extension GL_GOOGLE_include_directive : require
// The vertex color times the coverage from the font atlas (one byte per texel), with bilinear filtering.
#include "shared/arrays.glsl"
READ_UINT(2, font)
layout(push_constant) uniform Push {
  vec2 clipMin, clipSize;
  uint firstIndex;
  uint fontWidth, fontHeight;
};
layout(location = 0) in vec2 texel;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 result;

float coverage(ivec2 at) {
  const uvec2 inside = uvec2(clamp(at, ivec2(0), ivec2(fontWidth, fontHeight) - 1));
  const uint index = inside.y * fontWidth + inside.x;
  return float(fontAt(index >> 2) >> 8 * (index & 3u) & 255u) / 255.0;
}

void main() {
  const vec2 corner = floor(texel - 0.5), part = texel - 0.5 - corner;
  const ivec2 at = ivec2(corner);
  const float above = mix(coverage(at), coverage(at + ivec2(1, 0)), part.x);
  const float below = mix(coverage(at + ivec2(0, 1)), coverage(at + ivec2(1, 1)), part.x);
  const float alpha = color.a * mix(above, below, part.y);
  result = vec4(color.rgb * alpha, alpha);
}
