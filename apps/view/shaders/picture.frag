#version 460
#extension GL_GOOGLE_include_directive : require
// Draws an RGBA8 image over an area of the window, with bilinear scaling, blended over a background color.
#include "shared/arrays.glsl"
READ_UINT(0, picture)
layout(push_constant) uniform Push {
  uvec2 size;    // of the image, pixels
  vec2 scale;    // image pixels per window pixel
  vec2 corner;   // of the area in the window, pixels
  vec4 behind;
};
layout(location = 0) out vec4 result;

vec4 pixel(ivec2 at) {
  const uvec2 inside = uvec2(clamp(at, ivec2(0), ivec2(size) - 1));
  const vec4 p = unpackUnorm4x8(pictureAt(inside.y * size.x + inside.x));
  return vec4(p.rgb * p.a, p.a);
}

void main() {
  const vec2 place = (gl_FragCoord.xy - corner) * scale - 0.5, first = floor(place), part = place - first;
  const ivec2 at = ivec2(first);
  const vec4 p =
      mix(mix(pixel(at), pixel(at + ivec2(1, 0)), part.x), mix(pixel(at + ivec2(0, 1)), pixel(at + ivec2(1, 1)), part.x), part.y);
  result = vec4(p.rgb + (1.0 - p.a) * behind.rgb, 1.0);
}
