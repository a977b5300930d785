#version 460
// The rate of change of concentrations by diffusion, and the largest sum of weights of a particle, which bounds the step.
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
READ_FLOAT4(8, concentration)
layout(std430, binding = 9) writeonly buffer NextConcentrationBlock { vec4 nextConcentration[]; };
#define COMPANION(j) concentrationAt(j)
#define ROWS
#include "fluid/diffusion_rate.glsl"

void main() {
  uint i;
  bool inRange = gather(i);
  // Inactive particles coincide.
  float most = subgroupMax(inRange && isActive(here) ? row : 0.0);
  if (subgroupElect()) atomicMax(sums.diffusionRow, floatBitsToUint(most));
  if (inRange) nextConcentration[i] = isActive(here) ? diffusionRates() * exchange : vec4(0.0);
}
