#version 460
// Counting sort: scatters every index into its bin, in the nondeterministic order of the atomics.
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(constant_id = 0) const bool SKIP_NO_KEY = false;  // the caller's key pass has left some indices without a key

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
READ_UINT(0, key)
READ_UINT(1, start)
READ_UINT(2, rank)
layout(set = 0, binding = 3, std430) writeonly buffer Arrived { uint arrived[]; };

void main() {
  const uint i = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (i >= push.count) return;
  const uint key = keyAt(i);
  if (!SKIP_NO_KEY || key != kNoKey) arrived[startAt(min(key, push.lastKey)) + rankAt(i)] = i;
}
