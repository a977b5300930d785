#version 460
// A further stage of diffusion, from the one before it. Does nothing once there were as many as are needed.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, concentrationFrom)
layout(std430, binding = 9) writeonly buffer ConcentrationToBlock { vec4 concentrationTo[]; };
#define COMPANION(j) concentrationFromAt(j)
#include "fluid/diffusion_rate.glsl"

void main() {
  if (push.iteration >= sums.diffusionStages) return;
  uint i;
  if (!gather(i)) return;
  concentrationTo[i] = own + (isActive(here) ? sums.diffusionStep * diffusionRates() * exchange : vec4(0.0));
}
