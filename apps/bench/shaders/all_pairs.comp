// Brute-force search: every particle against [first, last), accumulated over ranges. Ranges keep loops short enough for driver limits.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "cloud.h"
#include "pair.glsl"
#include "shared/dispatch.glsl"
layout(local_size_x = kCloudGroup) in;
layout(push_constant) uniform PushBlock { CloudPush push; };
layout(binding = 0, std430) readonly buffer Positions { vec4 position[]; };
layout(binding = 1, std430) buffer Results { vec2 result[]; };

void main() {
  const uint i = flatInvocation();
  if (i >= push.count) return;
  PairSum sum = PairSum(0.0, 0u);
  if (push.first > 0u) sum = PairSum(result[i].x, uint(result[i].y));
  const vec3 here = position[i].xyz;
  for (uint j = push.first; j < push.last; ++j) addPair(sum, here, position[j].xyz, push.radius);
  result[i] = vec2(sum.density, sum.neighbors);
}
