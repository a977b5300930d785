#version 460
// The positions in the order of their cells, each with its place in the solver's arrays.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) readonly buffer OrderBlock { uint order[]; };
layout(std430, binding = 3) readonly buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 4) writeonly buffer SortedBlock { vec4 sorted[]; };

void main() {
  uint i = flatInvocation();
  if (i < params.count) sorted[i] = vec4(position[order[i]].xyz, uintBitsToFloat(order[i]));
}
