#version 460
// Counting sort: clears the counters, four at a time, and the list of oversized bins. A dispatch instead of
// a fill, so that a gate can skip it.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
layout(set = 0, binding = 0, std430) writeonly buffer Start { uvec4 start[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Oversized { uint oversized[]; };

void main() {
  const uint group = flatGroup();
  if (group == 0u && gl_LocalInvocationIndex == 0u) oversized[0] = 0u;
  for (uint j = 0u; j < kClearItems; ++j) {
    const uint k = (group * kClearItems + j) * kCountThreads + gl_LocalInvocationIndex;
    if (4u * k <= push.lastKey + 1u) start[k] = uvec4(0u);
  }
}
