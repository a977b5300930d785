#version 460
// Regions with a particle near a solid that may move, or whose loads are asked for, stay awake.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/regions.glsl"
#include "shared/arrays.glsl"
#include "shared/neighbor_list.h"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, position)
READ_UINT4(3, nearSolids)
READ_UINT(4, listHead)
layout(std430, binding = 5) readonly buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 6) buffer RegionBlock { RegionRecord regions[]; };
layout(std430, binding = 7) readonly buffer SumsBlock { FluidSums sums; };
#include "fluid/near_solids.glsl"

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids) return;
  NearSolids near = nearSolidsOf(n);
  vec3 x = positionAt(near.particle).xyz;
  // After a checkpoint without lists, each particle has an entry, but no head says so.
  if (!isActive(x) || (listHeadAt(near.particle) & kNearSolidsBit) == 0u) return;
  bool held = near.all;
  for (uint m = 0u, k; !near.all && nextSolid(near, m, k); ++m) held = held || solids[k].holdsAwake != 0u;
  if (held) atomicOr(regions[regionIndex(regionOf(x))].nearSolid, 1u);
}
