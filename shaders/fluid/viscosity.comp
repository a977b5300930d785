#version 460
// The residual of the implicit step of viscosity for the velocities as they are, and a bound of its eigenvalues.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, velocity)
layout(std430, binding = 9) writeonly buffer ResidualBlock { vec4 residual[]; };
layout(std430, binding = 10) readonly buffer HoldBlock { vec4 hold[]; };
READ_FLOAT4(11, priorVelocity)
// Where shear changes viscosities the solve starts from the velocities before the substep: a fluid that creeps nearly has the solution.
#define COMPANION(j) (SHEAR_VISCOSITY ? priorVelocityAt(j) : velocityAt(j))
#define BOUNDS
#include "fluid/viscous_force.glsl"

void main() {
  uint i;
  bool inRange = gatherForce(i);
  vec4 held = vec4(0.0);
  if (inRange) held = HOLD_AT(i);
  float most = subgroupMax(eigenvalueBound() + held.w);
  if (subgroupElect()) atomicMax(sums.viscosityBound, floatBitsToUint(most));
  if (inRange) residual[i] = vec4(sleeps(head) ? vec3(0.0) : force + held.xyz - held.w * own.xyz, SHEAR_VISCOSITY ? own.w : 0.0);
}
