#version 460
// Counting sort: orders bins too large for sort/order_bins. Workgroup c + chunks * k handles listed bins k,
// k + binGroups, ...: it sets a bit for each index of the bin that lies in chunk c, counts the bin's indices
// below the chunk, and writes the set bits in order. Linear in the bin size per chunk of 65,536 indices.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/arrays.glsl"
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { CountingPush push; };
READ_UINT(0, start)
READ_UINT(1, arrived)
layout(set = 0, binding = 2, std430) writeonly buffer Order { uint order[]; };
layout(set = 0, binding = 3, std430) readonly buffer Oversized { uint oversized[]; };  // count, then the keys

shared uint present[kChunkWords];
shared uint indicesBelow;

#define WORKGROUP_SCAN_THREADS kCountThreads
#include "sort/workgroup_scan.glsl"

void orderBin(uint key, uint firstIndex) {
  const uint begin = startAt(key);
  const uint end = startAt(key + 1u);

  for (uint w = gl_LocalInvocationIndex; w < kChunkWords; w += kCountThreads) present[w] = 0u;
  if (gl_LocalInvocationIndex == 0u) indicesBelow = 0u;
  barrier();

  uint below = 0u;
  for (uint slot = begin + gl_LocalInvocationIndex; slot < end; slot += kCountThreads) {
    const uint index = arrivedAt(slot);
    const uint inChunk = index - firstIndex;  // wraps around below the chunk, so one comparison checks both bounds
    if (inChunk < kChunkIndices) atomicOr(present[inChunk >> 5u], 1u << (inChunk & 31u));
    below += index < firstIndex ? 1u : 0u;
  }
  atomicAdd(indicesBelow, below);
  barrier();

  const uint wordsEach = kChunkWords / kCountThreads;
  const uint firstWord = scanLane() * wordsEach;
  uint mine = 0u;
  for (uint w = firstWord; w < firstWord + wordsEach; ++w) mine += uint(bitCount(present[w]));
  uint total;
  uint place = begin + indicesBelow + workgroupExclusiveAdd(mine, total);
  for (uint w = firstWord; w < firstWord + wordsEach; ++w) {
    for (uint word = present[w]; word != 0u; word &= word - 1u) order[place++] = firstIndex + 32u * w + uint(findLSB(word));
  }
  barrier();  // the next bin reuses the shared memory
}

void main() {
  const uint group = flatGroup();
  const uint bins = oversized[0], chunk = group % push.chunks;
  for (uint b = group / push.chunks; b < bins; b += push.binGroups) orderBin(oversized[1u + b], chunk * kChunkIndices);
}
