#version 460
// A line's coverage; OVER_FLUID, the binding of the surface: only where fluid is, whose surface has hidden the line.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#ifdef OVER_FLUID
layout(std430, set = 0, binding = OVER_FLUID) readonly buffer Surface { uvec2 surface[]; };
#endif
layout(location = 0) in float across;
layout(location = 1) flat in float half_width;
layout(location = 0) out vec4 color;

void main() {
#ifdef OVER_FLUID
  const uvec2 pixel = uvec2(gl_FragCoord.xy) - uvec2(view.left, view.top);
  if (surface[pixel.y * view.width + pixel.x].x >= kNoDepthBits) discard;
#endif
  const float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0) * 0.55;
  if (cover <= 0.0) discard;
  color = vec4(vec3(0.42, 0.50, 0.58) * cover, cover);
}
