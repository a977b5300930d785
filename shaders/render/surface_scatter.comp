#version 460
// Scatters surface particles into their cells, in an order that depends on atomics.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 1) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 2) readonly buffer Start { uint start[]; };
layout(std430, set = 0, binding = 3) readonly buffer Rank { uvec2 rank[]; };          // cell, rank in it
layout(std430, set = 0, binding = 4) writeonly buffer Arrived { uvec2 arrived[]; };  // particle, cell

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (k >= counters[kSurvivorCount] || rank[k].x == kNotSurface) return;
  arrived[start[rank[k].x] + rank[k].y] = uvec2(survivors[k], rank[k].x);
}
