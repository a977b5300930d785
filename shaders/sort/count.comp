#version 460
// Counting sort: how many keys of each value, and each one's rank of arrival among its equals.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) buffer Start { uint start[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Rank { uint rank[]; };

void main() {
  const uint i = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (i < push.count) rank[i] = atomicAdd(start[min(keys[i], push.lastKey)], 1u);
}
