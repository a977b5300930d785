#version 460
// Of each cell across the sun's rays: the particle nearest to the sun, and how many there are.
#extension GL_GOOGLE_include_directive : require
#include "render/crests.glsl"
#include "shared/active.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer ParticleCount { uint particle_count; };
layout(std430, set = 0, binding = 2) buffer Crests { uint crests[]; };  // two words a cell
layout(push_constant) uniform Push {
  float sunX, sunY, sunZ;  // unit vector
  float spacing;           // m
  uint capacity;
  uint side;               // cells, a power of two
};

void main() {
  const uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  if (i >= min(capacity, particle_count) || !drawable(position[i].xyz)) return;
  const vec3 sun = vec3(sunX, sunY, sunZ);
  const uint at = crestIndex(ivec2(floor(crestPlace(position[i].xyz, sun, spacing))), side);
  atomicMax(crests[2u * at], ordered(vec3(dot(position[i].xyz, sun))).x);
  atomicAdd(crests[2u * at + 1u], 1u);
}
