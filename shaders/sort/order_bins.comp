#version 460
// Counting sort: each bin in ascending order of index, which makes the sort stable and its result independent of the order of
// atomics. An index's place is the number of smaller ones in its bin. Bins above kBinLimit are listed for sort/order_oversized.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(constant_id = 0) const uint kWriteKeys = 0u;
layout(constant_id = 1) const uint kListOversized = 0u;

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) readonly buffer Start { uint start[]; };
layout(set = 0, binding = 2, std430) readonly buffer Arrived { uint arrived[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Order { uint order[]; };
layout(set = 0, binding = 4, std430) writeonly buffer SortedKeys { uint sortedKeys[]; };
layout(set = 0, binding = 5, std430) buffer OversizedGroups { uint oversizedGroups[3]; };
layout(set = 0, binding = 6, std430) writeonly buffer OversizedBins { uint oversizedBins[]; };

void main() {
  const uint slot = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (slot >= push.count) return;
  const uint index = arrived[slot];
  const uint key = min(keys[index], push.lastKey);
  const uint begin = start[key];
  const uint end = start[key + 1u];
  if (kWriteKeys != 0u) sortedKeys[slot] = key;
  if (kListOversized != 0u && end - begin > kBinLimit) {
    if (slot == begin) oversizedBins[atomicAdd(oversizedGroups[1], 1u)] = key;
    return;
  }
  uint place = begin;
  for (uint other = begin; other < end; ++other) place += arrived[other] < index ? 1u : 0u;
  order[place] = index;
}
