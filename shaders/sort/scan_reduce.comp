#version 460
// Scan, first step: the sum of each tile.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kScanThreads) in;
layout(push_constant) uniform PushBlock { ScanPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 1, std430) writeonly buffer TileSums { uint tileSums[]; };

#define WORKGROUP_SCAN_THREADS kScanThreads
#include "sort/workgroup_scan.glsl"

void main() {
  const uint tile = flatGroup();
  uint sum = 0u;
  for (uint j = 0u; j < kScanItems; ++j) {
    const uint i = tile * kScanTile + j * kScanThreads + gl_LocalInvocationIndex;
    if (i < push.count) sum += values[i];
  }
  uint total;
  workgroupExclusiveAdd(sum, total);
  if (gl_LocalInvocationIndex == 0u && tile * kScanTile < push.count) tileSums[tile] = total;
}
