#version 460
// Counting sort: every index into its bin, in the order of arrival, which differs from run to run.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) readonly buffer Start { uint start[]; };
layout(set = 0, binding = 2, std430) readonly buffer Rank { uint rank[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Arrived { uint arrived[]; };

void main() {
  const uint i = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (i < push.count) arrived[start[min(keys[i], push.lastKey)] + rank[i]] = i;
}
