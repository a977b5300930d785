#version 460
// Particles `seconds` later at the same velocities. Inactive ones stay where they are.
#extension GL_GOOGLE_include_directive : require
#include "shared/active.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Velocity { vec4 velocity[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Moved { vec4 moved[]; };
layout(push_constant) uniform Push { uint count; float seconds; };

void main() {
  const uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  if (i >= count) return;
  const vec4 at = position[i];
  moved[i] = drawable(at.xyz) ? vec4(at.xyz + seconds * velocity[i].xyz, at.w) : at;
}
