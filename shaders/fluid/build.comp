#version 460
// The neighbour list of the sorted particles (those nearer than support plus skin), and the sorted arrays copied back in place.
// A particle's true neighbour count is kept: one with more than the list holds walks the grid in every pass, and is counted.
// Gathers from the sorted predictions.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#include "fluid/uniforms.glsl"
#include "fluid/grid.glsl"
#include "fluid/solids.glsl"
#include "shared/pair_hash.h"
layout(local_size_x = kFluidGroup) in;
layout(constant_id = 1) const uint LIST_CAPACITY = 0;
layout(constant_id = 2) const uint NEAR = 0;

layout(push_constant) uniform Push { ChunkPush push; };
#ifdef TEXEL
layout(binding = 2) uniform samplerBuffer particleArray;
#define PARTICLE(j) texelFetch(particleArray, int(j))
#else
layout(std430, binding = 2) readonly buffer ParticleBlock { vec4 particleArray[]; };
#define PARTICLE(j) particleArray[j]
#endif
layout(std430, binding = 3) writeonly buffer ListBlock { uint list[]; };
layout(std430, binding = 4) writeonly buffer CountBlock { uint neighbourCount[]; };
layout(std430, binding = 5) writeonly buffer KeyBlock { uint cell[]; };
layout(std430, binding = 6) readonly buffer StartBlock { uint cellStart[]; };
layout(std430, binding = 7) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 8) readonly buffer SortedPositionBlock { vec4 sortedPosition[]; };
layout(std430, binding = 9) readonly buffer SortedVelocityBlock { vec4 sortedVelocity[]; };
layout(std430, binding = 10) readonly buffer SortedScalarBlock { uvec2 sortedScalar[]; };
layout(std430, binding = 11) writeonly buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 12) writeonly buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 13) writeonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 14) writeonly buffer WarmBlock { float warm[]; };
layout(std430, binding = 15) writeonly buffer IdBlock { uint id[]; };
layout(std430, binding = 16) writeonly buffer NearBlock { vec4 nearSample[]; };
layout(std430, binding = 17) writeonly buffer NearListBlock { uint nearList[]; };
layout(std430, binding = 18) readonly buffer SolidBlock { SolidRecord solids[]; };

const uint kNone = 0xffffffffu;

// Lists the particle among those near one wall (from the front of nearList) or near several walls or a solid (from its back).
void listNear(uint i, vec3 x) {
  vec3 low = x - vec3(params.lowX, params.lowY, params.lowZ);
  vec3 high = vec3(params.highX, params.highY, params.highZ) - x;
  uvec3 sides = uvec3(lessThan(low, vec3(params.nearLimit))) + uvec3(lessThan(high, vec3(params.nearLimit)));
  uint walls = sides.x + sides.y + sides.z;
  bool solid = false;
  for (uint s = 0u; s < params.solidCount; ++s) {
    vec3 normal;
    if (surfaceDistance(solids[s], toLocal(solids[s], x), normal) < params.nearLimit) solid = true;
  }
  nearSample[i] = vec4(0.0);
  if (x.x == kParked) return;
  if (solid || walls > 1u) nearList[params.count - 1u - atomicAdd(sums.cornerCount, 1u)] = i;
  else if (walls == 1u) nearList[atomicAdd(sums.planeCount, 1u)] = i;
}

void main() {
  uint local = flatInvocation();
  uint i = push.first + local;
  if (i >= push.last) return;
  vec4 predicted = PARTICLE(i);
  vec3 x = predicted.xyz;
  uvec3 home = cellOf(x);
  cell[i] = cellKey(home);

  uint at = ((local / kListBlock) * (kListBlock * (LIST_CAPACITY / 4u)) + local % kListBlock) * 4u;
  uint count = 0u, looked = 0u, twin = kNone;
  float reachSquared = params.reach * params.reach;
  float twinSquared = 1.0e-6 * params.support * params.support;
  uint parts = home.x < kCellsPerReach || home.x + kCellsPerReach > gridMask.x ? 2u : 1u;
  uint rows = x.x == kParked ? 0u : 9u;
  for (uint row = 0u; row < rows; ++row) {
    int low, high;
    rowReach(x, params.reach, row, low, high);
    for (uint part = 0u; part < parts; ++part) {
      uint first, last;
      rowKeys(home, row, low, high, part, first, last);
      uint begin = cellStart[first];
      uint end = first == last ? begin : cellStart[last];
      for (uint base = begin; base < end && looked < kWalkBound; base += 32u) {
        uint most = min(32u, end - base);
        looked += most;
        uint mask = 0u;
        for (uint k = 0u; k < most; ++k) {
          vec3 r = x - PARTICLE(base + k).xyz;
          float squared = dot(r, r);
          mask |= uint(squared < reachSquared) << k;
          twin = squared < twinSquared && base + k != i ? base + k : twin;
        }
        if (i - base < 32u) mask &= ~(1u << (i - base));
        if (LIST_CAPACITY != 0u) {
          while (mask != 0u) {
            uint j = base + findLSB(mask);
            mask &= mask - 1u;
            if (count < LIST_CAPACITY) list[at + (count >> 2u) * (4u * kListBlock) + (count & 3u)] = j;
            count += 1u;
          }
        }
      }
    }
  }
  if (looked >= kWalkBound) atomicAdd(sums.boundHits, 1u);
  if (LIST_CAPACITY != 0u) {
    neighbourCount[i] = count;
    if (count > LIST_CAPACITY) atomicAdd(sums.overflow, 1u);
    for (uint n = min(count, LIST_CAPACITY); (n & 3u) != 0u; ++n) list[at + (n >> 2u) * (4u * kListBlock) + (n & 3u)] = params.count;
  }

  vec3 from = sortedPosition[i].xyz;
  uvec2 scalar = sortedScalar[i];
  if (twin != kNone) {  // coinciding particles have no direction to part in: each takes one from both numbers, opposite for the two
    uint other = sortedScalar[twin].y;
    vec3 apart = vec3(pairDirection(scalar.y, other, 0u), pairDirection(scalar.y, other, 1u), pairDirection(scalar.y, other, 2u)) *
                 (0.02 / 1024.0 * params.spacing);
    x = insideWalls(x + apart);
    from = insideWalls(from + apart);
  }
  position[i] = vec4(from, 0.0);
  prediction[i] = vec4(x, predicted.w);
  velocity[i] = sortedVelocity[i];
  warm[i] = uintBitsToFloat(scalar.x);
  id[i] = scalar.y;
  if (NEAR != 0u) listNear(i, x);
}
