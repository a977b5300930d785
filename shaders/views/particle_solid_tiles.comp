#version 460
// For every tile, a bit a solid: set where the solid may be seen in it. An invocation makes one word.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Placed { PlacedSolid placed[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Masks { uint masks[]; };
#include "views/particle_light.glsl"
#define MEETS_TILE
#include "views/particle_frustum.glsl"

void main() {
  const uint index = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  const uint words = solidWords();
  if (index >= surfaceTiles() * words) return;
  const uint tile = index / words, first = index % words * 32u;
  const uint columns = surfaceColumns();
  uint mask = 0u;
  RILL_LOOP for (uint k = 0u; k < 32u && first + k < scene.counts.x; ++k) {
    if (meetsTile(placed[first + k], uvec2(tile % columns, tile / columns))) mask |= 1u << k;
  }
  masks[index] = mask;
}
