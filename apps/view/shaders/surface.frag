#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
// Copies the window's picture, sRGB-encoded values, to an image of another format.
layout(constant_id = 0) const bool kEncodes = false;  // the image's format encodes what is written
layout(set = 0, binding = 0) uniform texture2D canvas;
layout(location = 0) out vec4 result;
#include "views/srgb.glsl"

void main() {
  const vec3 color = texelFetch(canvas, ivec2(gl_FragCoord.xy), 0).rgb;
  result = vec4(kEncodes ? decodeSrgb(color) : color, 1.0);
}
