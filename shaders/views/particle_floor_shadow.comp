#version 460
// Filtered visibility of the light on the floor, per texel of the light map; each texel maps to one point of the floor.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer LightMap { uint light_map[]; };
layout(std430, set = 0, binding = 2) writeonly buffer FloorLight { float floor_light[]; };

// Light depth of the floor at a texel.
float floorDepth(vec2 texel) {
  const float u = scene.light_u.w + texel.x * scene.light_texel.x, v = scene.light_v.w + texel.y * scene.light_texel.x;
  return scene.light_to.w - (scene.domain_min.y - u * scene.light_u.y - v * scene.light_v.y) / scene.light_to.y;
}

void main() {
  const uint index = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  const ivec2 size = ivec2(scene.counts.yz);
  if (index >= scene.counts.y * scene.counts.z) return;
  const ivec2 at = ivec2(index % scene.counts.y, index / scene.counts.y);
  const float bias = 0.25 * view.radius;
  float sum = 0.0;
  RILL_LOOP for (int y = -2; y <= 2; ++y) {
    RILL_LOOP for (int x = -2; x <= 2; ++x) {
      const ivec2 texel = clamp(at + ivec2(x, y), ivec2(0), size - 1);
      const uint limit = floatBitsToUint(max(floorDepth(vec2(texel)) - bias, 0.0));
      if (light_map[texel.y * size.x + texel.x] >= limit) sum += float((3 - abs(x)) * (3 - abs(y)));
    }
  }
  floor_light[index] = sum / 81.0;
}
