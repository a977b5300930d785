#version 460
// Vorticity of the velocity field, curl v (Macklin and Mueller 2013, equation 15): xyz the curl, w
// its length, 1/s. Gathers from `work`, and velocities.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, velocity)

layout(std430, binding = 9) writeonly buffer CurlBlock { vec4 curl[]; };

#define COMPANION(j) velocityAt(j)

vec3 here;
vec3 own;
vec3 turning = vec3(0.0);

void visit(vec4 particle, vec4 companion) {
  vec3 r = here - particle.xyz;
  turning += cross(gradientShape(sqrt(dot(r, r))) * r, companion.xyz - own);
}
#include "fluid/neighbors.glsl"

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < min(push.last, control.solved);
  if (!inRange) i = params.capacity;
  here = particleAt(i).xyz;
  own = velocityAt(i).xyz;
  visitNeighbors(i, headOf(i, inRange), local, inRange);
  if (!inRange) return;
  turning *= params.gradientScale;
  curl[i] = vec4(turning, length(turning));
  if (i == 0u) curl[params.capacity] = vec4(0.0);  // the dummy neighbor, whose weight of 0 would not do away with a NaN
}
