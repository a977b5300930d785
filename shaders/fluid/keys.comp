#version 460
// The grid cell of each place, as a sort key. COUNTED: and how many particles each cell has, for a counting sort.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/regions.glsl"
#include "shared/arrays.glsl"
#include "sort/sort_types.h"
#ifdef COUNTED
#define COUNTERS 7
#include "sort/count.glsl"
#endif
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, place)
layout(std430, binding = 3) writeonly buffer KeyBlock { uint key[]; };
layout(std430, binding = 4) buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(5, position)
layout(std430, binding = 6) readonly buffer RegionBlock { RegionRecord regions[]; };
#include "fluid/zones.glsl"

// What sleeps stays where it is, behind all that does not; inactive particles come last.
uint keyOf(uint i) {
  vec3 x = placeAt(i).xyz;
  if (REMOVES && !isActive(x)) return (REGIONS ? 2u : 1u) * cellCount();
  if (!REGIONS || !REBUILDS) return cellKey(cellOf(x));
  vec3 from = positionAt(i).xyz;
  uint zone = zoneOf(from);
  return cellKey(cellOf(zone == kZoneMoves ? x : from)) + (zone == kZoneAsleep ? cellCount() : 0u);
}

void main() {
  uint i = flatInvocation();
  if (REBUILDS && i == 0u) {
    sums.nearSolids = sums.nearMouths = 0u;
    sums.overflow = 0u;
    sums.asleep = 0u;
    sums.columnCountX = sums.columnCountY = sums.columnCountZ = 0u;
    sums.columnLowX = sums.columnLowY = sums.columnLowZ = 0xffffffffu;
    sums.columnHighX = sums.columnHighY = sums.columnHighZ = 0u;
    sums.columnSumLowX = sums.columnSumLowY = sums.columnSumLowZ = 0u;
    sums.columnSumHighX = sums.columnSumHighY = sums.columnSumHighZ = 0u;
  }
#ifdef COUNTED
  // The sort's workgroups are larger: what they see behind the last particle is no key.
  uint padded = min((max(control.count, 1u) + kCountThreads - 1u) / kCountThreads * kCountThreads, params.capacity);
  for (uint j = i; j < min(i + kCountThreads, padded); j += kFluidGroup)
    if (j >= control.count) key[j] = kNoKey;
#else
  if (i >= control.count && i < params.capacity) key[i] = kNoKey;
#endif
  if (i >= control.count) return;
  uint cell = keyOf(i);
  key[i] = cell;
#ifdef COUNTED
  countKey(i, cell);
#endif
}
