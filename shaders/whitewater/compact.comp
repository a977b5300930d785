#version 460
// Puts the particles that live on behind each other, in their order.
#extension GL_GOOGLE_include_directive : require
#include "whitewater/whitewater.glsl"

layout(local_size_x = kWhiteGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer MovedPlace { vec4 moved_place[]; };
layout(std430, set = 0, binding = 1) readonly buffer MovedMotion { uvec4 moved_motion[]; };
layout(std430, set = 0, binding = 2) readonly buffer Alive { uint alive[]; };  // scanned
layout(std430, set = 0, binding = 3) buffer WhitePlace { vec4 white_place[]; };
layout(std430, set = 0, binding = 4) buffer WhiteMotion { uvec4 white_motion[]; };
layout(std430, set = 0, binding = 5) buffer Counts { uint counts[]; };

void main() {
  const uint k = flatInvocation();
  if (k >= counts[kWhiteBefore]) return;
  const uint to = alive[k];
  if (alive[k + 1u] == to) return;
  white_place[to] = moved_place[k];
  white_motion[to] = moved_motion[k];
  atomicAdd(counts[kWhiteSprayCount + (moved_motion[k].w & 3u)], 1u);
}
