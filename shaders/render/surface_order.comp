#version 460
// Sorts each cell by particle number, so that sums do not depend on the order of atomics; centers in view space.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Start { uint start[]; };
layout(std430, set = 0, binding = 3) readonly buffer Arrived { uvec2 arrived[]; };  // particle, cell
layout(std430, set = 0, binding = 4) writeonly buffer Center { vec4 center[]; };

void main() {
  const uint slot = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (slot >= counters[kSurfaceCount]) return;
  const uint i = arrived[slot].x, key = arrived[slot].y;
  const uint begin = start[key], end = start[key + 1u];
  uint place = begin;
  for (uint other = begin; other < min(end, begin + kMaxInCell); ++other) place += arrived[other].x < i ? 1u : 0u;
  if (end - begin > kMaxInCell) {  // coincident particles stay in the order of arrival
    place = slot;
    if (slot == begin) atomicAdd(counters[kBoundHits], 1u);
  }
  center[place] = vec4(viewPoint(position[i].xyz), 0.0);
}
