#version 460
// One sweep of XSPH (Schechter and Bridson 2012; Macklin and Mueller 2013, equation 17), its
// coefficient that of a dynamic viscosity in Pa s: the fluid's own, or that which calms noise. The
// pairs are those of the density pass: gathers from `work`, and velocities. Predicts anew with the
// velocity it ends with.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define WARM_CONSTANT 4
#include "fluid/warm_start.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { SweepPush push; };
READ_FLOAT4(8, velocity)
layout(std430, binding = 9) writeonly buffer SmoothedBlock { vec4 smoothed[]; };
layout(std430, binding = 10) writeonly buffer PredictionBlock { vec4 prediction[]; };
READ_FLOAT4(11, warmAcceleration)
READ_FLOAT4(12, position)

#define COMPANION(j) velocityAt(j)

vec3 here;
vec4 own;
vec3 change = vec3(0.0);

void visit(vec4 particle, vec4 companion) {
  vec3 r = here - particle.xyz;
  change += kernelShape(sqrt(dot(r, r))) * (companion.xyz - own.xyz);
}
#include "fluid/neighbors.glsl"

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < push.last;
  if (!inRange) i = params.count;
  here = particleAt(i).xyz;
  own = velocityAt(i);
  visitNeighbors(i, local, inRange);
  if (!inRange) return;
  float coefficient = push.share > 0.0 ? params.viscosityRate * control.step * push.share : control.noiseDamping;
  vec3 v = own.xyz + coefficient * params.valueScale * change;
  smoothed[i] = vec4(v, own.w);
  if (i == 0u) smoothed[params.count] = vec4(0.0);  // the dummy neighbor, whose weight of 0 would not do away with a NaN
  prediction[i] = vec4(insideWalls(predicted(positionAt(i).xyz, v, KEPT_WARM_ACCELERATION(warmAccelerationAt(i)))), 0.0);
}
