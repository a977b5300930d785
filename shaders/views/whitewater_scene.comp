#version 460
// Copies the depth of the scene (m) before the fluid is drawn over it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(set = 0, binding = 0) uniform texture2D host_depth;
layout(std430, set = 0, binding = 1) writeonly buffer SceneDepth { float scene_depth[]; };

void main() {
  const uint index = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (index >= view.width * view.height) return;
  const ivec2 pixel = ivec2(index % view.width + view.left, index / view.width + view.top);
  scene_depth[index] = depthOfTarget(texelFetch(host_depth, pixel, 0).r);
}
