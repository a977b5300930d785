#version 460
// Scatters surface particles into their cells, in an order that depends on atomics.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 3) readonly buffer Start { uint start[]; };
layout(std430, set = 0, binding = 4) readonly buffer Rank { uint rank[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Arrived { uint arrived[]; };

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (k >= counters[kSurvivorCount] || rank[k] == kNotSurface) return;
  const uint i = survivors[k];
  const ivec2 cell = cellOf(pixelOf(viewPoint(position[i].xyz)));
  arrived[start[uint(cell.y) * cellGrid().x + uint(cell.x)] + rank[k]] = i;
}
