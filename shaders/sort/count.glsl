// Counting sort: counts the keys of each value and stores each key's rank among equal keys. The invocation
// that makes a bin oversized adds it to the list. The shader defines COUNTERS, the first of three bindings.
#ifndef RILL_COUNT_GLSL
#define RILL_COUNT_GLSL
#include "sort/sort_types.h"
#ifndef LIST_OVERSIZED_ID
#define LIST_OVERSIZED_ID 0
#endif
layout(constant_id = LIST_OVERSIZED_ID) const bool LIST_OVERSIZED = false;

layout(set = 0, binding = COUNTERS, std430) buffer Start { uint start[]; };
layout(set = 0, binding = COUNTERS + 1, std430) writeonly buffer Rank { uint rank[]; };
layout(set = 0, binding = COUNTERS + 2, std430) buffer Oversized { uint oversized[]; };  // count, then the keys

void countKey(uint i, uint key) {
  const uint before = atomicAdd(start[key], 1u);
  rank[i] = before;
  if (LIST_OVERSIZED && before == kBinLimit) oversized[1u + atomicAdd(oversized[0], 1u)] = key;
}
#endif
