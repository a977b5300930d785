// Which solids may be near the particles of a workgroup: those whose bounding spheres reach the box around them. With CULL_SOLIDS, which
// scenes of many solids have; else every solid may. Needs `params` and solidAt().
#ifndef RILL_CULL_SOLIDS_GLSL
#define RILL_CULL_SOLIDS_GLSL
#include "shared/ordered_floats.glsl"
#include "shared/pose.glsl"
#include "shared/shape.glsl"

shared uint groupLow[3], groupHigh[3], groupSolids[kMaxSolids / 32u];

// By all invocations of the workgroup; `counts`: x is that of a particle.
void cullSolids(vec3 x, bool counts) {
  uint lane = gl_LocalInvocationIndex;
  if (lane < 3u) {
    groupLow[lane] = 0xffffffffu;
    groupHigh[lane] = 0u;
  }
  for (uint word = lane; word < kMaxSolids / 32u; word += kFluidGroup) groupSolids[word] = 0u;
  barrier();
  uvec3 low = subgroupMin(counts ? ordered(x) : uvec3(0xffffffffu)), high = subgroupMax(counts ? ordered(x) : uvec3(0u));
  if (subgroupElect()) {
    for (uint axis = 0u; axis < 3u; ++axis) {
      atomicMin(groupLow[axis], low[axis]);
      atomicMax(groupHigh[axis], high[axis]);
    }
  }
  barrier();
  vec3 from = fromOrdered(uvec3(groupLow[0], groupLow[1], groupLow[2])), to = fromOrdered(uvec3(groupHigh[0], groupHigh[1], groupHigh[2]));
  bool some = groupHigh[0] != 0u;
  for (uint k = lane; some && k < params.solidCount; k += kFluidGroup) {
    SolidRecord s = solidAt(k);
    vec3 middle = centerOf(s.pose) + toScene(s.pose, middleOf(s.shape));
    float radius = s.shape.kind == kShapeSphere ? s.shape.halfX : length(halfExtents(s.shape));
    radius += params.nearLimit + params.spacing;  // a sheet is thicker than its bounds, and rounding
    if (distance(middle, clamp(middle, from, to)) < radius) atomicOr(groupSolids[k / 32u], 1u << k % 32u);
  }
  barrier();
}

// The solids 32 `word` + b for the bits b.
uint solidsMayBeNear(uint word) {
  uint left = params.solidCount - 32u * word;
  return CULL_SOLIDS ? groupSolids[word] : 0xffffffffu >> (32u - min(left, 32u));
}
#endif
