#version 460
// Scan, first step: sums each tile.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/arrays.glsl"
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kScanThreads) in;
layout(push_constant) uniform PushBlock { ScanPush push; };
READ_UINT4(0, values)
layout(set = 0, binding = 1, std430) writeonly buffer TileSums { uint tileSums[]; };

shared uint tileSum;

void main() {
  const uint tile = flatGroup();
  if (gl_LocalInvocationIndex == 0u) tileSum = 0u;
  barrier();
  uint sum = 0u;
  for (uint j = 0u; j < kScanItems / 4u; ++j) {
    const uint i = tile * (kScanTile / 4u) + j * kScanThreads + gl_LocalInvocationIndex;
    const uvec4 four = 4u * i < push.count ? valuesAt(i) : uvec4(0u);
    sum += four.x + four.y + four.z + four.w;  // padding only affects the last tile's sum, which is never used
  }
  sum = subgroupAdd(sum);
  if (subgroupElect()) atomicAdd(tileSum, sum);
  barrier();
  if (gl_LocalInvocationIndex == 0u && tile * kScanTile < push.count) tileSums[tile] = tileSum;
}
