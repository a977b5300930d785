#version 460
// The positions in the order of their cells, each with its place in the solver's arrays (shared/number.glsl).
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/sorted_places.glsl"
#include "shared/number.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(6, position)
layout(std430, binding = 7) writeonly buffer OrderedPositionBlock { vec4 orderedPosition[]; };

void main() {
  uint slot = flatInvocation();
  if (slot >= control.count) return;
  uint place, from = arrival(slot, place);
  orderedPosition[place] = vec4(positionAt(from).xyz, numberToFloat(from));
}
