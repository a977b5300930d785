// Pixels of a finished picture, and where its edges are (Lottes 2009, FXAA). Defines binding 0.
#extension GL_EXT_control_flow_attributes : require
#include "shared/arrays.glsl"
#include "views/finish_records.h"

layout(push_constant) uniform Push { AntialiasPush push; };
READ_UINT(0, aliased)  // RGBA8, sRGB

const float kMinContrast = 0.06, kMinRelativeContrast = 0.15;  // of an edge: absolute, and relative to the brightest pixel

uint pixelAt(ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(push.width, push.height) - 1);
  return aliasedAt(uint(p.y) * push.width + uint(p.x));
}
vec3 colorOf(uint pixel) { return vec3(pixel & 0xFFu, (pixel >> 8) & 0xFFu, (pixel >> 16) & 0xFFu) / 255.0; }
float lumaOf(uint pixel) { return dot(colorOf(pixel), vec3(0.299, 0.587, 0.114)); }
float lumaAt(ivec2 p) { return lumaOf(pixelAt(p)); }
