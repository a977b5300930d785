#version 460
// The first stage of diffusion, whose rate is in place of its result. A step of one stage is done.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer ConcentrationBlock { vec4 concentration[]; };
layout(std430, binding = 3) buffer NextConcentrationBlock { vec4 nextConcentration[]; };
layout(std430, binding = 4) readonly buffer SumsBlock { FluidSums sums; };

void main() {
  uint i = flatInvocation();
  bool goesOn = sums.diffusionStages > 1u;
  if (goesOn && i == 0u) nextConcentration[params.capacity] = vec4(0.0);  // the dummy neighbor: its weight of 0 would keep a NaN
  if (i >= control.solved) return;
  vec4 c = concentration[i] + sums.diffusionStep * nextConcentration[i];
  if (goesOn) nextConcentration[i] = c;
  else concentration[i] = c;
}
