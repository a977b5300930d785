#version 460
// A further step of viscosity: the residual after the last one, and along it. Does nothing once there were as many as are needed.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
#include "shared/viscosity_steps.h"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, directionFrom)
layout(std430, binding = 9) buffer ResidualBlock { vec4 residual[]; };
layout(std430, binding = 10) writeonly buffer DirectionToBlock { vec4 directionTo[]; };
layout(std430, binding = 11) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 12) readonly buffer HoldBlock { vec4 hold[]; };
#define COMPANION(j) directionFromAt(j)
#include "fluid/viscous_force.glsl"
#include "fluid/viscosity_scale.glsl"

void main() {
  uint k = push.iteration;
  if (k >= sums.viscositySteps) return;
  uint i;
  if (!gatherForce(i)) return;
  float held = HOLD_AT(i).w;
  if (SHEAR_VISCOSITY) {
    float scale = viscosityScale(sums.viscosityBound);
    force *= scale;
    held *= scale;
  }
  vec3 d = own.xyz, r = residual[i].xyz - (1.0 + held) * d + force;
  float ratio = chebyshevRatio(sums.viscosityDecay, k);
  d = ratio * (chebyshevRatio(sums.viscosityDecay, k - 1u) * d + 2.0 / sums.viscosityHalfWidth * r);
  residual[i].xyz = r;
  directionTo[i] = vec4(d, SHEAR_VISCOSITY ? own.w : 0.0);
  velocity[i].xyz += d;
  if (i == 0u) directionTo[params.capacity] = vec4(0.0);
}
