#version 460
// Which of the particles are surface: those that own enough of their own disc. Counts them in the cells of the screen grid.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 3) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) buffer Cells { uint cells[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Rank { uint rank[]; };

const float kOwnedShare = 0.03;  // of a disc: less is a neighbour's rim showing through

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (k >= counters[kSurvivorCount]) return;
  const vec3 centre = viewPoint(position[survivors[k]].xyz);
  const float radius = hardRadius(centre.z);
  bool cut;
  const ivec4 rect = sampleRect(centre, radius, cut);
  if (cut) atomicAdd(counters[kBoundHits], 1u);
  const uint columns = sampleGrid().x;
  const float slack = 1e-3 * view.spacing;
  uint inside = 0u, owned = 0u;
  for (int y = rect.y; y <= rect.w; ++y)
    for (int x = rect.x; x <= rect.z; ++x) {
      const float t = sphereDepth(centre, radius, axisOf(samplePixel(ivec2(x, y))));
      if (t < 0.0) continue;
      ++inside;
      if (t <= uintBitsToFloat(depth[uint(y) * columns + uint(x)]) + slack) ++owned;
    }
  uint place = kNotSurface;
  if (owned > 0u && float(owned) >= kOwnedShare * float(inside)) {
    const ivec2 cell = cellOf(pixelOf(centre));
    place = atomicAdd(cells[uint(cell.y) * cellGrid().x + uint(cell.x)], 1u);
    atomicAdd(counters[kSurfaceCount], 1u);
  }
  rank[k] = place;
}
