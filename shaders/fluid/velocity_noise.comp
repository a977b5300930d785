#version 460
// w L v, which noise damping filters a second time: the difference of the kernel's mean from each velocity, less
// where that mean is a flow, faster than noise is (docs/notes/noise-damping.md). And how much of a particle's motion that flow
// is, for the rest of the block (docs/notes/background-pressure.md).
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
layout(std430, binding = 9) writeonly buffer SweepToBlock { vec4 sweepTo[]; };
layout(std430, binding = 10) writeonly buffer CoherenceBlock { float coherence[]; };
READ_FLOAT(11, warm)
#include "fluid/background_pressure.glsl"
#include "fluid/xsph.glsl"

void main() {
  uint i;
  if (!gatherDifference(i)) return;
  vec3 mean = own.xyz + difference;
  float noise = kSparedFlow * kSparedFlow * params.layerHead + dot(difference, difference);
  float flow = min(dot(mean, mean) / noise, 1e9);
  sweepTo[i] = vec4(difference / (1.0 + flow * flow), 0.0);
  float layers = WARM ? -warmAt(i) * inverseMassOf(fluid) / max(control.warmStep * control.warmStep * params.layerHead, 1.0e-30) : 0.0;
  coherence[i] = coherenceOf(mean, difference, layers);
  if (i == 0u) sweepTo[params.capacity] = vec4(0.0);  // the dummy neighbor, whose weight of 0 would not do away with a NaN
}
