#version 460
// The grid cell of each position, as a sort key.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/grid.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) readonly buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 3) writeonly buffer KeyBlock { uint key[]; };

void main() {
  uint i = flatInvocation();
  if (i < params.count) key[i] = cellKey(cellOf(position[i].xyz));
}
