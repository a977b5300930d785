#version 460
// Copies the host's color (linear) and depth, for refraction and because the fluid overwrites both.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(set = 0, binding = 0) uniform texture2D host_color;
layout(set = 0, binding = 1) uniform texture2D host_depth;
layout(std430, set = 0, binding = 2) writeonly buffer SceneColor { uvec2 scene_color[]; };  // four halves per pixel
layout(std430, set = 0, binding = 3) writeonly buffer SceneDepth { float scene_depth[]; };

void main() {
  const uint index = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (index >= view.width * view.height) return;
  const ivec2 pixel = ivec2(index % view.width + view.left, index / view.width + view.top);
  const vec4 color = min(texelFetch(host_color, pixel, 0), vec4(65504.0));  // of a half
  scene_color[index] = uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba));
  scene_depth[index] = texelFetch(host_depth, pixel, 0).r;
}
