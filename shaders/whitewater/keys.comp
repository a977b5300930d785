#version 460
// The bin of each fluid particle; white.bins for those that are inactive or too far away.
#extension GL_GOOGLE_include_directive : require
#include "whitewater/whitewater.glsl"

layout(local_size_x = kWhiteGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer ParticleCount { uint particle_count; };
layout(std430, set = 0, binding = 2) writeonly buffer Keys { uint keys[]; };

void main() {
  const uint i = flatInvocation();
  if (i >= white.capacity) return;
  const bool used = i < min(particle_count, white.particles) && drawable(position[i].xyz) && inGrid(position[i].xyz);
  keys[i] = used ? binOf(cellAt(position[i].xyz)) : white.bins;
}
