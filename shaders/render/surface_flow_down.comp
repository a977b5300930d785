#version 460
// A level of the flow's pyramid from the finer one: the mean of those of four samples that are on the nearest surface.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "shared/arrays.glsl"
#include "render/surface_filter.glsl"

READ_FLOAT(0, finer)
layout(std430, set = 0, binding = 1) writeonly buffer Coarse { float coarse[]; };
layout(std430, set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
#define BLOCKS 3
#define LEVELS
#include "render/surface_block.glsl"
#include "render/surface_pyramid.glsl"

void main() {
  ivec2 p;
  if (!ownSample(p)) return;
  const ivec2 finer_grid = finerGrid();
  float corners[4], nearest = noDepth();
  for (int k = 0; k < 4; ++k) {
    const ivec2 q = 2 * p + ivec2(k & 1, k >> 1);
    corners[k] = all(lessThan(q, finer_grid)) ? finerAt(uint(q.y * finer_grid.x + q.x)) : noDepth();
    nearest = min(nearest, corners[k]);
  }
  if (nearest >= noDepth()) return;
  const float edge = edgeAt(nearest);
  float sum = 0.0, count = 0.0;
  for (int k = 0; k < 4; ++k)
    if (corners[k] - nearest < edge) {
      sum += toLinear(corners[k]);
      count += 1.0;
    }
  coarse[uint(p.y * int(sampleGrid().x) + p.x)] = toDepth(sum / count);
}
