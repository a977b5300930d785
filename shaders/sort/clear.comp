#version 460
// Counting sort: counters to zero, and no oversized bin yet. A dispatch and not a fill, so that a gate can leave it out.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
layout(set = 0, binding = 0, std430) writeonly buffer Start { uint start[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Oversized { uint oversizedGroups[3]; };

void main() {
  const uint group = flatGroup();
  if (group == 0u && gl_LocalInvocationIndex == 0u) {
    oversizedGroups[0] = push.chunks;
    oversizedGroups[1] = 0u;
    oversizedGroups[2] = 1u;
  }
  for (uint j = 0u; j < kClearItems; ++j) {
    const uint k = (group * kClearItems + j) * kCountThreads + gl_LocalInvocationIndex;
    if (k <= push.lastKey + 1u) start[k] = 0u;
  }
}
