#version 460
// Counting sort: how many keys of each value, and each one's rank of arrival among its equals. Who makes a bin oversized lists it.
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(constant_id = 0) const uint kListOversized = 0u;

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
READ_UINT(0, key)
layout(set = 0, binding = 1, std430) buffer Start { uint start[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Rank { uint rank[]; };
layout(set = 0, binding = 3, std430) buffer Oversized { uint oversized[]; };  // how many, and their keys

void main() {
  const uint i = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (i >= push.count) return;
  const uint key = min(keyAt(i), push.lastKey);
  const uint before = atomicAdd(start[key], 1u);
  rank[i] = before;
  if (kListOversized != 0u && before == kBinLimit) oversized[1u + atomicAdd(oversized[0], 1u)] = key;
}
