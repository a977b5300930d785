// Counting sort: counts the keys of each value and stores each key's rank among equal keys. The invocation
// that makes a bin oversized adds it to the list. The shader defines COUNTERS, the first of three bindings;
// constants 0 and 1 are KeySort::counterConstants().
#ifndef RILL_COUNT_GLSL
#define RILL_COUNT_GLSL
#include "sort/sort_types.h"
layout(constant_id = 0) const uint kListOversized = 0u;
layout(constant_id = 1) const uint kCounts = 0u;  // 0: the sort has no counters, and the bindings are unused

layout(set = 0, binding = COUNTERS, std430) buffer Start { uint start[]; };
layout(set = 0, binding = COUNTERS + 1, std430) writeonly buffer Rank { uint rank[]; };
layout(set = 0, binding = COUNTERS + 2, std430) buffer Oversized { uint oversized[]; };  // count, then the keys

void countKey(uint i, uint key) {
  if (kCounts == 0u) return;
  const uint before = atomicAdd(start[key], 1u);
  rank[i] = before;
  if (kListOversized != 0u && before == kBinLimit) oversized[1u + atomicAdd(oversized[0], 1u)] = key;
}
#endif
