#version 460
// Positions and velocities of the fluid in the order of the bins, and the columns of cells that they lie in.
#extension GL_GOOGLE_include_directive : require
#include "whitewater/whitewater.glsl"

layout(local_size_x = kWhiteGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Velocity { vec4 velocity[]; };
layout(std430, set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(std430, set = 0, binding = 3) readonly buffer Start { uint start[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Place { uvec4 place[]; };  // bits of m; column
layout(std430, set = 0, binding = 5) writeonly buffer Motion { vec4 motion[]; };

void main() {
  const uint slot = flatInvocation();
  if (slot >= start[white.bins]) return;
  const uint i = order[slot];
  const vec3 v = velocity[i].xyz;
  place[slot] = uvec4(floatBitsToUint(position[i].xyz), columnOf(cellAt(position[i].xyz).xy));
  motion[slot] = vec4(isWithin(v, 1e6) ? v : vec3(0.0), 0.0);
}
