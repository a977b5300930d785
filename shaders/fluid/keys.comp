#version 460
// The grid cell of each place, as a sort key, and how many particles each cell has.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/grid.glsl"
#include "shared/arrays.glsl"
#define COUNTERS 5
#include "sort/count.glsl"
layout(local_size_x = kFluidGroup) in;
layout(constant_id = 2) const uint REBUILDS = 0;  // the list is built after this
READ_FLOAT4(2, place)
layout(std430, binding = 3) writeonly buffer KeyBlock { uint key[]; };
layout(std430, binding = 4) buffer SumsBlock { FluidSums sums; };

void main() {
  uint i = flatInvocation();
  if (REBUILDS != 0u && i == 0u) {
    sums.planeCount = 0u;
    sums.cornerCount = 0u;
    sums.overflow = 0u;
    sums.columnCountX = sums.columnCountY = sums.columnCountZ = 0u;
    sums.columnLowX = sums.columnLowY = sums.columnLowZ = 0xffffffffu;
    sums.columnHighX = sums.columnHighY = sums.columnHighZ = 0u;
    sums.columnSumLowX = sums.columnSumLowY = sums.columnSumLowZ = 0u;
    sums.columnSumHighX = sums.columnSumHighY = sums.columnSumHighZ = 0u;
  }
  if (i >= params.count) return;
  uint cell = cellKey(cellOf(placeAt(i).xyz));
  key[i] = cell;
  countKey(i, cell);
}
