#version 460
// The concentrations in the order of the cells, as reorder.comp has the particles.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/sorted_places.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(6, concentration)
layout(std430, binding = 7) writeonly buffer NextConcentrationBlock { vec4 nextConcentration[]; };

void main() {
  uint slot = flatInvocation();
  if (slot >= control.count) return;
  uint place, from = arrival(slot, place);
  nextConcentration[place] = concentrationAt(from);
}
