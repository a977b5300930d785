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
READ_FLOAT4(5, prediction)  // w, of a particle that sleeps: 1 where a solid is near
READ_UINT(6, listHead)
layout(std430, binding = 7) buffer RegionBlock { RegionRecord regions[]; };

ivec3 terms(vec3 x) { return ivec3(round(clamp(x, -kMaxRegionTerm, kMaxRegionTerm) / kRegionUnit)); }

void main() {
  uint i = flatInvocation();
  if (i >= control.count) return;
  vec3 x = positionAt(i).xyz, v = velocityAt(i).xyz;
  if (!isActive(x)) return;
  uint r = regionIndex(regionOf(x));
  bool still = v == vec3(0.0), unsolved = i >= control.solved;
  // Those that were just born have no list.
  bool nearSolid = SOLIDS && (unsolved ? still && predictionAt(i).w > 0.0
                                       : (listHeadAt(i) & kNearSolidsBit) != 0u ||
                                             ((listHeadAt(i) & kAsleepBit) != 0u && predictionAt(i).w > 0.0));
  if (nearSolid) atomicOr(regions[r].busy, 1u);
  if (unsolved && still) return;  // asleep, with all of its region

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
