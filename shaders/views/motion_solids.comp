#version 460
// Solids that the fluid or the host moves, `seconds` later at the same velocities.
#extension GL_GOOGLE_include_directive : require
#include "shared/pose.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer FluidSolids { SolidRecord fluidSolids[]; };
layout(std430, set = 0, binding = 1) writeonly buffer MovedSolids { SolidRecord movedSolids[]; };
layout(push_constant) uniform Push { uint count; float seconds; };

void main() {
  const uint i = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
  if (i >= count) return;
  SolidRecord solid = fluidSolids[i];
  if (solid.driven != 0u || solid.body != kNoBody) solid.pose = later(solid.pose, seconds);
  movedSolids[i] = solid;
}
