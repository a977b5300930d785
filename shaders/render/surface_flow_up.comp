#version 460
// From a level of the flow's pyramid to the finer one: interpolates the four samples around if they are on this surface. At an edge it
// interpolates their displacement by the flow, because a one-sided mean would be biased.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "shared/arrays.glsl"
#include "render/surface_filter.glsl"

READ_FLOAT(0, before)
READ_FLOAT(1, started)  // the coarser level before the flow
READ_FLOAT(2, flowed)
layout(std430, set = 0, binding = 3) writeonly buffer After { float after[]; };
layout(std430, set = 0, binding = 4) readonly buffer Counters { uint counters[]; };
#define BLOCKS 5
#define LEVELS
#include "render/surface_block.glsl"
#include "render/surface_pyramid.glsl"

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const float z = beforeAt(index);
  if (z >= noDepth()) return;
  const ivec2 coarse_grid = coarserGrid();
  const vec2 at = (vec2(p) + 0.5) * 0.5 - 0.5;
  const ivec2 base = ivec2(floor(at));
  const vec2 part = at - vec2(base);
  const float edge = edgeAt(z);
  float sum = 0.0, moved = 0.0, weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1), q = clamp(base + corner, ivec2(0), coarse_grid - 1);
    const uint neighbor = uint(q.y * coarse_grid.x + q.x);
    const float now = flowedAt(neighbor);
    if (abs(now - z) >= edge) continue;
    const vec2 share = mix(1.0 - part, part, vec2(corner));
    const float w = share.x * share.y;
    sum += w * toLinear(now);
    moved += w * (now - startedAt(neighbor));
    weights += w;
  }
  after[index] = weights > 0.999 ? toDepth(sum / weights) : (weights > 0.0 ? z + moved / weights : z);
}
