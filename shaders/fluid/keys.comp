#version 460
// The grid cell of each prediction, as a sort key.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/grid.glsl"
#include "shared/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, prediction)
layout(std430, binding = 3) writeonly buffer KeyBlock { uint key[]; };
layout(std430, binding = 4) buffer SumsBlock { FluidSums sums; };

void main() {
  uint i = flatInvocation();
  if (i == 0u) {
    sums.planeCount = 0u;
    sums.cornerCount = 0u;
    sums.overflow = 0u;
  }
  if (i >= params.count) return;
  key[i] = cellKey(cellOf(predictionAt(i).xyz));
}
