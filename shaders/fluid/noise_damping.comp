#version 460
// Noise damping, v -= c L(w L v) with (L v)_i = sum_j K_ij (v_j - v_i) and the weight w from velocity_noise.comp. A wave loses with
// the fourth power of its wave number, where XSPH takes the second: see docs/notes/noise-damping.md.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, sweepFrom)
layout(std430, binding = 9) buffer VelocityBlock { vec4 velocity[]; };
#include "fluid/xsph.glsl"

void main() {
  uint i;
  if (!gatherDifference(i)) return;
  velocity[i].xyz -= control.noiseDamping * difference;
}
