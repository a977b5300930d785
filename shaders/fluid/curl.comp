#version 460
// Vorticity of the velocity field, curl v (Macklin and Mueller 2013, equation 15): xyz the curl, 1/s, w its length over the density.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/kernel.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
#ifdef TEXEL
layout(binding = 8) uniform samplerBuffer velocityArray;
#define VELOCITY(j) texelFetch(velocityArray, int(j))
#else
layout(std430, binding = 8) readonly buffer VelocityBlock { vec4 velocityArray[]; };
#define VELOCITY(j) velocityArray[j]
#endif

layout(std430, binding = 9) writeonly buffer CurlBlock { vec4 curl[]; };

vec3 here;
vec3 own;
vec3 turning = vec3(0.0);

void visit(uint j, vec4 particle) {
  vec3 r = here - particle.xyz;
  vec4 other = VELOCITY(j);
  vec3 gradient = kernelGradient(sqrt(dot(r, r))) * r;
  turning += cross(gradient, (other.xyz - own) / max(other.w, 0.1));
}
#include "fluid/neighbours.glsl"

void main() {
  uint local = flatInvocation();
  uint i = push.first + local;
  if (i >= push.last) return;
  here = PARTICLE(i).xyz;
  vec4 mine = VELOCITY(i);
  own = mine.xyz;
  visitNeighbours(i, local);
  curl[i] = vec4(turning, length(turning) / max(mine.w, 0.1));
}
