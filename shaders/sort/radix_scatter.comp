#version 460
// Radix sort: scatters the keys of a tile. Each invocation ranks consecutive keys, which keeps the sort
// stable. Keys are read twice instead of copied to shared memory: docs/notes/sorting.md. FIRST: of the first
// pass, where a key's index is its position. WRITE_KEYS: a later pass or the caller reads the keys.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kRadixThreads) in;
layout(push_constant) uniform PushBlock { RadixPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) readonly buffer Offsets { uint offsets[]; };  // [digit][tile]
layout(set = 0, binding = 2, std430) writeonly buffer OrderOut { uint orderOut[]; };
#ifdef WRITE_KEYS
layout(set = 0, binding = 3, std430) writeonly buffer KeysOut { uint keysOut[]; };
#define NEXT_BINDING 4
#else
#define NEXT_BINDING 3
#endif
#ifndef FIRST
layout(set = 0, binding = NEXT_BINDING, std430) readonly buffer Order { uint order[]; };
#endif

const uint kRow = kRadixThreads + 1u;
// Two 16-bit counters per word: keys of a digit in the tile before the invocation's next key.
shared uint counters[(1u << kRadixBits) / 2u * kRow];
shared uint base[1u << kRadixBits];

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const uint tile = flatGroup();
  const uint first = tile * kRadixTile;
  const uint count = first < push.count ? min(push.count - first, kRadixTile) : 0u;
  const uint words = push.digits / 2u;

  for (uint w = 0u; w < words; ++w) counters[w * kRow + lane] = 0u;
  if (lane < push.digits && count != 0u) base[lane] = offsets[lane * push.tiles + tile];

  const uint mine = min(count - min(lane * kRadixKeys, count), kRadixKeys);
  for (uint j = 0u; j < mine; ++j) {
    const uint digit = (keys[first + lane * kRadixKeys + j] >> push.shift) & (push.digits - 1u);
    counters[(digit >> 1u) * kRow + lane] += 1u << ((digit & 1u) * 16u);
  }
  barrier();

  if (lane < words) {
    uint running = 0u;
    for (uint other = 0u; other < kRadixThreads; ++other) {
      const uint here = counters[lane * kRow + other];
      counters[lane * kRow + other] = running;
      running += here;
    }
  }
  barrier();

  for (uint j = 0u; j < mine; ++j) {
    const uint e = first + lane * kRadixKeys + j;
    const uint key = keys[e];
    const uint digit = (key >> push.shift) & (push.digits - 1u);
    const uint word = (digit >> 1u) * kRow + lane;
    const uint side = (digit & 1u) * 16u;
    const uint target = base[digit] + ((counters[word] >> side) & 0xffffu);
    counters[word] += 1u << side;
#ifdef WRITE_KEYS
    keysOut[target] = key;
#endif
#ifdef FIRST
    orderOut[target] = e;
#else
    orderOut[target] = order[e];
#endif
  }
}
