#version 460
// The sorted concentrations back in place.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) writeonly buffer ConcentrationBlock { vec4 concentration[]; };
layout(std430, binding = 3) readonly buffer NextConcentrationBlock { vec4 nextConcentration[]; };

void main() {
  uint i = flatInvocation();
  if (i < control.count) concentration[i] = nextConcentration[i];
}
