#version 460
// Sums over the particles of each region, from which the next pass finds those at rest: docs/notes/sleep.md.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/regions.glsl"
#include "shared/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, position)
READ_FLOAT4(3, velocity)
READ_FLOAT4(4, warmAcceleration)
READ_UINT(5, listHead)
layout(std430, binding = 6) buffer RegionBlock { RegionRecord regions[]; };
layout(std430, binding = 7) readonly buffer SolidBlock { SolidRecord solids[]; };
READ_UINT(8, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"

// Of a particle without a list of the solids near it; rest_solids.comp is for the others.
bool isHeldAwake(vec3 x) {
  for (uint k = 0u; SOLIDS && k < params.solidCount; ++k) {
    vec3 normal;
    if (solids[k].holdsAwake == 0u || isBeyond(centerOf(solids[k].pose), solids[k].radius, x, params.nearLimit)) continue;
    if (surfaceDistance(solids[k].shape, localPoint(solids[k].pose, x), normal) < params.nearLimit) return true;
  }
  return false;
}

ivec3 terms(vec3 x) { return ivec3(round(clamp(x, -kMaxRegionTerm, kMaxRegionTerm) / kRegionUnit)); }

void main() {
  uint i = flatInvocation();
  if (i >= control.count) return;
  vec3 x = positionAt(i).xyz, v = velocityAt(i).xyz;
  if (!isActive(x)) return;
  uint r = regionIndex(regionOf(x));
  bool isBehind = i >= control.solved && v == vec3(0.0);  // in a region that sleeps; what was just born moves
  if (SOLIDS) {
    bool hasList = i < control.solved && (listHeadAt(i) & kAsleepBit) == 0u;
    if (!hasList && isHeldAwake(x)) atomicOr(regions[r].nearSolid, 1u);
  }
  if (isBehind) return;

  float fall = sqrt(params.layerHead), speed = length(v) / fall;
  atomicAdd(regions[r].particles, 1u);
  atomicMax(regions[r].fastest, floatBitsToUint(length(v)));
  atomicAdd(regions[r].motion, uint(min(speed * speed, kMaxRegionMotion) / kRegionMotionUnit));
  vec3 moving = keptWarmAcceleration(warmAccelerationAt(i)) + gravity();
  ivec3 drift = terms(v / fall), force = terms(moving * (params.spacing / params.layerHead));
  atomicAdd(regions[r].driftX, drift.x);
  atomicAdd(regions[r].driftY, drift.y);
  atomicAdd(regions[r].driftZ, drift.z);
  atomicAdd(regions[r].forceX, force.x);
  atomicAdd(regions[r].forceY, force.y);
  atomicAdd(regions[r].forceZ, force.z);
}
