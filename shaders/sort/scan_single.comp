#version 460
// Scan of few values in place by one workgroup, tile by tile.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "sort/sort_types.h"

layout(local_size_x = kScanThreads) in;
layout(push_constant) uniform PushBlock { ScanPush push; };
layout(set = 0, binding = 0, std430) buffer Values { uvec4 values[]; };

#define WORKGROUP_SCAN_THREADS kScanThreads
#include "sort/scan_tile.glsl"

void main() {
  uint carry = 0u;
  for (uint first = 0u; first < push.count; first += kScanTile) {
    carry += scanTile(first, carry);
    barrier();  // the next iteration overwrites the shared sums
  }
}
