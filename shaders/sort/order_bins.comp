#version 460
// Counting sort: orders each bin by ascending index. Bins above kBinLimit are handled by sort/order_oversized.
// WRITE_KEYS: the caller wants the sorted keys.
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(constant_id = 0) const bool SKIP_OVERSIZED = false;

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
READ_UINT(0, key)
READ_UINT(1, start)
READ_UINT(2, arrived)
#include "sort/place.glsl"
layout(set = 0, binding = 3, std430) writeonly buffer Order { uint order[]; };
#ifdef WRITE_KEYS
layout(set = 0, binding = 4, std430) writeonly buffer SortedKeys { uint sortedKeys[]; };
#endif

void main() {
  const uint slot = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (slot >= push.count) return;
  const uint index = arrivedAt(slot);
  const uint key = min(keyAt(index), push.lastKey);
  const uint begin = startAt(key);
  const uint end = startAt(key + 1u);
#ifdef WRITE_KEYS
  sortedKeys[slot] = key;
#endif
  if (SKIP_OVERSIZED && end - begin > kBinLimit) return;
  order[placeOf(index, begin, end)] = index;
}
