#version 460
// Dispatch arguments of passes over all particles of a state: an invocation for each, at most its capacity.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push {
  uint capacity;
  uint group_size;  // invocations
};
layout(std430, set = 0, binding = 0) readonly buffer ParticleCount { uint particle_count; };
layout(std430, set = 0, binding = 1) writeonly buffer ParticleGroups { uint particle_groups[]; };

void main() {
  const uvec3 groups = foldGroups((min(particle_count, capacity) + group_size - 1u) / group_size);
  particle_groups[0] = groups.x;
  particle_groups[1] = groups.y;
  particle_groups[2] = groups.z;
}
