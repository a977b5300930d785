#version 460
// Radix sort: start[k] = number of keys smaller than k, by binary search in the sorted keys.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kCountThreads) in;
layout(push_constant) uniform PushBlock { StartPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Start { uint start[]; };

void main() {
  const uint key = flatGroup() * kCountThreads + gl_LocalInvocationIndex;
  if (key > push.range) return;
  uint low = 0u, high = push.count;
  while (low < high) {
    const uint middle = (low + high) / 2u;
    if (keys[middle] < key) low = middle + 1u;
    else high = middle;
  }
  start[key] = low;
}
