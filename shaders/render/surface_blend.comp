#version 460
// The blended surface of every sample that a sphere covers.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
#include "render/surface_arrays.glsl"
layout(std430, set = 0, binding = 3) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(std430, set = 0, binding = 5) buffer Counters { uint counters[]; };
#include "render/surface_blend.glsl"
#include "render/surface_solid.glsl"

void main() {
  const uvec2 grid = sampleGrid();
  const uint columns = (grid.x + 7u) / 8u;
  const uvec2 at = uvec2(groupIndex() % columns, groupIndex() / columns) * 8u + gl_LocalInvocationID.xy;
  if (at.x >= grid.x || at.y >= grid.y) return;
  const uint index = at.y * grid.x + at.x;
  const float hard = uintBitsToFloat(depth[index]);
  if (hard == infinity()) {
    samples[index] = uvec2(kInfiniteBits, 0u);
    return;
  }
  const Blend blend = blendAt(axisOf(samplePixel(ivec2(at))), hard);
  samples[index] = blend.coverage >= 0.5 || solidAround(ivec2(at)) ? uvec2(floatBitsToUint(blend.depth), packNormal(blend.normal)) : uvec2(kInfiniteBits, 0u);
  if (bound_hit) atomicAdd(counters[kBoundHits], 1u);
}
