#version 460
// One sweep of XSPH (Schechter and Bridson 2012; Macklin and Mueller 2013, equation 17), its
// coefficient that of a dynamic viscosity in Pa s: the fluid's own, or that of noise damping. The
// pairs are those of the density pass: gathers from `work`, and velocities.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { SweepPush push; };
READ_FLOAT4(8, sweepFrom)
layout(std430, binding = 9) writeonly buffer SweepToBlock { vec4 sweepTo[]; };

#define COMPANION(j) sweepFromAt(j)

vec3 here;
vec4 own;
vec3 change = vec3(0.0);

void visit(vec4 particle, vec4 companion) {
  vec3 r = here - particle.xyz;
  change += kernelShape(sqrt(dot(r, r))) * (companion.xyz - own.xyz);
}
void reflectSums(vec3 signs) {  // images move as in a mirror
  change *= signs;
  own.xyz *= signs;
}
#define IMAGES
#include "fluid/neighbors.glsl"

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < min(push.last, control.count);
  if (!inRange) i = params.capacity;
  here = particleAt(i).xyz;
  own = sweepFromAt(i);
  visitNeighbors(i, headOf(i, inRange), local, inRange);
  if (!inRange) return;
  float coefficient = push.share > 0.0 ? params.viscosityRate * control.step * push.share : control.noiseDamping;
  vec3 v = own.xyz + coefficient * params.valueScale * change;
  sweepTo[i] = vec4(v, own.w);
  if (i == 0u) sweepTo[params.capacity] = vec4(0.0);  // the dummy neighbor, whose weight of 0 would not do away with a NaN
}
