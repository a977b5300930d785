#version 460
// One sweep of XSPH (Schechter and Bridson 2012; Macklin and Mueller 2013, equation 17), its coefficient that of a dynamic viscosity in Pa s: the
// fluid's own, or that which calms noise.
// The pairs are those of the density pass: gathers from `work`, and velocities. Predicts anew with the velocity it ends with.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { SweepPush push; };
#ifdef TEXEL
layout(binding = 8) uniform samplerBuffer velocityArray;
#define VELOCITY(j) texelFetch(velocityArray, int(j))
#else
layout(std430, binding = 8) readonly buffer VelocityBlock { vec4 velocityArray[]; };
#define VELOCITY(j) velocityArray[j]
#endif
layout(std430, binding = 9) writeonly buffer SmoothedBlock { vec4 smoothed[]; };
layout(std430, binding = 10) writeonly buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 11) readonly buffer PushBlock { vec4 pushAway[]; };
layout(std430, binding = 12) readonly buffer PositionBlock { vec4 position[]; };

#define COMPANION(j) VELOCITY(j)

vec3 here;
vec4 own;
vec3 change = vec3(0.0);

void visit(vec4 particle, vec4 companion) {
  vec3 r = here - particle.xyz;
  change += kernelShape(sqrt(dot(r, r))) * (companion.xyz - own.xyz);
}
#include "fluid/neighbours.glsl"

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool there = i < push.last;
  if (!there) i = params.count;
  here = PARTICLE(i).xyz;
  own = VELOCITY(i);
  visitNeighbours(i, local, there);
  if (!there) return;
  float coefficient = push.share > 0.0 ? params.viscosityRate * control.step * push.share : control.calming;
  vec3 v = own.xyz + coefficient * params.valueScale * change;
  smoothed[i] = vec4(v, own.w);
  if (i == 0u) smoothed[params.count] = vec4(0.0);  // the dummy neighbour, whose weight of 0 would not do away with a NaN
  prediction[i] = vec4(insideWalls(predicted(position[i].xyz, v, pushAway[i].xyz)), 0.0);
}
