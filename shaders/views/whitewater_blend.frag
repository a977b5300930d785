#version 460
// Whitewater over the picture: that behind the fluid's surface, then that before it. Light is scattered white, more towards the sun.
#extension GL_GOOGLE_include_directive : require
#include "render/look_records.h"
#include "render/surface.glsl"
#include "shared/arrays.glsl"
#include "views/whitewater_view_records.h"

layout(std140, set = 0, binding = 0) uniform Look { LookRecord look; };
#include "render/sky.glsl"
READ_UINT4(1, dots)  // layers of a pixel
layout(location = 0) out vec4 color;

const float kAlbedo = 0.85;
const float kUnderwater = 0.7;  // of the light enters the water and leaves it again

float opacityOf(uint count) { return 1.0 - exp(-float(count) / kWhiteOpacity); }
float before(ivec2 pixel) {
  const uvec2 at = uvec2(clamp(pixel, ivec2(0), ivec2(view.width, view.height) - 1));
  return opacityOf(dotsAt(at.y * view.width + at.x).x);
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(view.left, view.top);
  const uvec4 counts = dotsAt(uint(pixel.y) * view.width + uint(pixel.x));
  const float front = opacityOf(counts.x);
  const vec3 under = 1.0 - exp(-vec3(counts.yzw) / kWhiteOpacity);
  if (front <= 0.0 && under.r + under.g + under.b <= 0.0) discard;
  // Where the density grows there is the shaded side of a cloud of drops
  const ivec2 across = ivec2(1, 0), down = ivec2(0, 1);
  const vec2 slope = vec2(before(pixel + across) - before(pixel - across), before(pixel + down) - before(pixel - down));
  const vec3 normal = normalize(vec3(-slope.x, slope.y, -0.8));
  const float facing = 0.5 + 0.5 * dot(worldDirection(normal), look.light.xyz);
  const vec3 above = skyLight(vec3(0.0, 1.0, 0.0));
  const vec3 white = kAlbedo * (above + sunlight() * (0.25 + 0.6 * facing));
  const vec3 dim = kUnderwater * kAlbedo * (above + 0.6 * sunlight());
  const float covered = (under.r + under.g + under.b) / 3.0;
  color = vec4(dim * under * (1.0 - front) + white * front, covered * (1.0 - front) + front);
}
