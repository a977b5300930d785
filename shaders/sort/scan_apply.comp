#version 460
// Scan, last step: scans each tile in place, starting from the sum of the previous tiles.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/arrays.glsl"
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(constant_id = 0) const bool SUMS_SCANNED = false;  // false: each workgroup adds up the sums of previous tiles

layout(local_size_x = kScanThreads) in;
layout(push_constant) uniform PushBlock { ScanPush push; };
layout(set = 0, binding = 0, std430) buffer Values { uvec4 values[]; };
READ_UINT(1, tileSums)

#define WORKGROUP_SCAN_THREADS kScanThreads
#include "sort/scan_tile.glsl"

shared uint sumBefore;

uint offsetOf(uint tile) {
  if (SUMS_SCANNED) return tileSumsAt(tile);
  if (gl_LocalInvocationIndex == 0u) sumBefore = 0u;
  barrier();
  uint sum = 0u;
  for (uint t = gl_LocalInvocationIndex; t < tile; t += kScanThreads) sum += tileSumsAt(t);
  sum = subgroupAdd(sum);
  if (subgroupElect()) atomicAdd(sumBefore, sum);
  barrier();
  return sumBefore;
}

void main() {
  const uint tile = flatGroup();
  if (tile * kScanTile < push.count) scanTile(tile * kScanTile, offsetOf(tile));
}
