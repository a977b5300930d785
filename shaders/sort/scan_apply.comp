#version 460
// Scan, last step, in place: each tile, from the sum of the tiles before it.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/dispatch.glsl"
#include "sort/sort_types.h"

layout(local_size_x = kScanThreads) in;
layout(push_constant) uniform PushBlock { ScanPush push; };
layout(set = 0, binding = 0, std430) buffer Values { uint values[]; };
layout(set = 0, binding = 1, std430) readonly buffer TileOffsets { uint tileOffsets[]; };

#define WORKGROUP_SCAN_THREADS kScanThreads
#include "sort/scan_tile.glsl"

void main() {
  const uint first = flatGroup() * kScanTile;
  if (first < push.count) scanTile(first, tileOffsets[flatGroup()]);
}
