#version 460
// Copies the velocities back after an odd number of viscosity sweeps.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) readonly buffer SweepFromBlock { vec4 sweepFrom[]; };
layout(std430, binding = 3) writeonly buffer VelocityBlock { vec4 velocity[]; };

void main() {
  uint i = flatInvocation();
  if (i < control.solved) velocity[i] = sweepFrom[i];
}
