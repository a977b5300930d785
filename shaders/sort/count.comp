#version 460
// Counting sort: counts the keys.
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "shared/dispatch.glsl"
#define COUNTERS 1
#include "sort/count.glsl"

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
READ_UINT(0, key)

void main() {
  const uint i = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (i < push.count) countKey(i, min(keyAt(i), push.lastKey));
}
