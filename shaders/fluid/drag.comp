#version 460
// Linear drag against air at rest: dv/dt = -drag v, solved exactly over the substep.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer VelocityBlock { vec4 velocity[]; };

void main() {
  uint i = flatInvocation();
  if (i < control.solved) velocity[i].xyz *= exp(-params.drag * control.step);
}
