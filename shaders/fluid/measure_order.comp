#version 460
// The positions in the order of their cells, each with its place in the solver's arrays, as a number.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
READ_UINT(2, order)
READ_FLOAT4(3, position)
layout(std430, binding = 4) writeonly buffer SortedBlock { vec4 sorted[]; };

void main() {
  uint i = flatInvocation();
  if (i >= params.count) return;
  uint from = orderAt(i);
  sorted[i] = vec4(positionAt(from).xyz, float(from));
}
