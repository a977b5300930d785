#version 460
// Where shear changes viscosities, particles follow the velocities that viscosity left them. Without it what stands would sink by what
// gravity adds to its speed in every substep.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/shear_viscosity.h"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) readonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 3) readonly buffer PriorBlock { vec4 priorVelocity[]; };
layout(std430, binding = 4) buffer PositionBlock { vec4 position[]; };

void main() {
  uint i = flatInvocation();
  if (i >= control.solved || control.phase != kPhaseAdvancing) return;
  vec4 x = position[i];
  vec3 along = control.step * (velocity[i].xyz - priorVelocity[i].xyz);
  float longest = kShearDisplacement * params.spacing, size = length(along);
  vec3 moved = x.xyz + (size > longest ? along * (longest / size) : along);
  if (isActive(x.xyz) && isFinite(moved)) position[i].xyz = insideWalls(moved);
}
