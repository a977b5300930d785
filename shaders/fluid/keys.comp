#version 460
// The grid cell of each place, as a sort key. COUNTED: and how many particles each cell has, for a counting sort.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/grid.glsl"
#include "shared/arrays.glsl"
#ifdef COUNTED
#define COUNTERS 5
#include "sort/count.glsl"
#endif
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, place)
layout(std430, binding = 3) writeonly buffer KeyBlock { uint key[]; };
layout(std430, binding = 4) buffer SumsBlock { FluidSums sums; };

void main() {
  uint i = flatInvocation();
  if (REBUILDS && i == 0u) {
    sums.planeCount = 0u;
    sums.cornerCount = 0u;
    sums.overflow = 0u;
  }
  if (i >= params.count) return;
  uint cell = cellKey(cellOf(placeAt(i).xyz));
  key[i] = cell;
#ifdef COUNTED
  countKey(i, cell);
#endif
}
