#version 460
// Radix sort: counts the digits of each tile. Every invocation counts into its own bytes (64 keys fit), so
// there are no atomics; then invocation d sums digit d.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kRadixThreads) in;
layout(push_constant) uniform PushBlock { RadixPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Histogram { uint histogram[]; };  // [digit][tile]

const uint kRow = kRadixThreads + 1u;  // padding against bank conflicts
shared uint counters[(1u << kRadixBits) / 4u * kRow];

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const uint tile = flatGroup();
  for (uint w = 0u; w < (push.digits + 3u) / 4u; ++w) counters[w * kRow + lane] = 0u;
  for (uint j = 0u; j < kRadixKeys; ++j) {
    const uint i = tile * kRadixTile + j * kRadixThreads + lane;
    if (i < push.count) {
      const uint digit = (keys[i] >> push.shift) & (push.digits - 1u);
      counters[(digit >> 2u) * kRow + lane] += 1u << ((digit & 3u) * 8u);
    }
  }
  barrier();
  if (lane < push.digits && tile < push.tiles) {
    uint sum = 0u;
    for (uint other = 0u; other < kRadixThreads; ++other) sum += (counters[(lane >> 2u) * kRow + other] >> ((lane & 3u) * 8u)) & 255u;
    histogram[lane * push.tiles + tile] = sum;
  }
}
