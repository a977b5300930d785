#version 460
// The first step of viscosity: along the residual.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/viscosity_scale.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer ResidualBlock { vec4 residual[]; };
layout(std430, binding = 3) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 4) writeonly buffer DirectionToBlock { vec4 directionTo[]; };
layout(std430, binding = 5) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 6) buffer PriorBlock { vec4 priorVelocity[]; };

void main() {
  uint i = flatInvocation();
  bool goesOn = params.viscositySteps > 1u;
  if (goesOn && i == 0u) directionTo[params.capacity] = vec4(0.0);  // the dummy neighbor, whose weight of 0 would not do away with a NaN
  if (i >= control.solved) return;
  vec4 r = residual[i];
  if (SHEAR_VISCOSITY) {
    vec3 prior = priorVelocity[i].xyz, free = velocity[i].xyz;
    r.xyz = free - prior + viscosityScale(sums.viscosityBound) * r.xyz;
    residual[i] = r;
    velocity[i].xyz = prior;
    priorVelocity[i].xyz = free;  // for viscous_displacement.comp
  }
  vec3 d = r.xyz / sums.viscosityCenter;
  velocity[i].xyz += d;
  if (goesOn) directionTo[i] = vec4(d, SHEAR_VISCOSITY ? r.w : 0.0);
}
