#version 460
// The block of each particle as a key; kMeshNone for particles that are inactive or too far away.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/active.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer ParticleCount { uint particle_count; };
layout(std430, set = 0, binding = 2) writeonly buffer Keys { uint keys[]; };
layout(std430, set = 0, binding = 3) buffer Counts { uint counts[]; };

void main() {
  const uint i = flatInvocation();
  if (i >= mesh.capacity) return;
  uint key = kMeshNone;
  if (i < min(particle_count, mesh.particles) && drawable(position[i].xyz)) {
    const vec3 x = position[i].xyz / mesh.spacing;
    // Beyond this an int would overflow
    if (isWithin(x, 1e6) && inGrid(binAt(x) >> 2))
      key = keyOf(binAt(x) >> 2);
    else
      atomicAdd(counts[kMeshTooFar], 1u);
  }
  keys[i] = key;
}
