#version 460
// One sweep of XSPH, its coefficient that of the fluid's dynamic viscosity in Pa s.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { SweepPush push; };
READ_FLOAT4(8, sweepFrom)
layout(std430, binding = 9) writeonly buffer SweepToBlock { vec4 sweepTo[]; };
#define REVERSES NO_SLIP_WALLS
#include "fluid/xsph.glsl"

void main() {
  uint i;
  if (!gatherDifference(i)) return;
  sweepTo[i] = vec4(own.xyz + params.viscosityRate * control.step * push.share * difference, own.w);
  if (i == 0u) sweepTo[params.capacity] = vec4(0.0);  // the dummy neighbor, whose weight of 0 would not do away with a NaN
}
