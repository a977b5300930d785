#version 460
// Surface tension, first pass: lists the particles that may have exposed samples, and clears the forces.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/surface_list.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
layout(std430, binding = 6) buffer SurfaceParticleBlock { uint surfaceParticle[]; };
layout(std430, binding = 7) writeonly buffer ForceBlock { int surfaceForce[]; };

// Whether one of its samples can be so near to a wall that its weight is not 1.
bool nearWall(vec3 x) {
  float reach = (kTensionRadius + 1.0) * params.spacing;
  return WALLS && (any(lessThan(x, wallsLow() + reach)) || any(greaterThan(x, wallsHigh() - reach)));
}

bool isDeep(uint head, uint local) {
  uint count = head & kUnlisted;
  bool listed = LIST_CAPACITY != 0u && count != 0u && count != kUnlisted && (head & (kSegmentsBit | kNearSolidsBit)) == kSegmentsBit;
  return listed && (listAt(firstGroup(local)).x & 0xfffu) >> kSegmentGroupBits == kDeepSegment;
}

void main() {
  uint local = flatInvocation();
  uint i = push.first + local;
  if (i >= min(push.last, control.solved)) return;
  for (uint k = 0u; k < 3u; ++k) surfaceForce[3u * i + k] = 0;
  uint head = LIST_CAPACITY != 0u || SOLIDS || MOUTHS || REGIONS ? listHeadAt(i) : 0u;
  vec3 x = particleAt(i).xyz;
  bool asleep = REGIONS && (head & kAsleepBit) != 0u;
  if (!isActive(x) || asleep || (isDeep(head, local) && !nearWall(x))) return;
  surfaceParticle[push.first + atomicAdd(surfaceParticle[surfaceCounter(push.first)], 1u)] = i;
}
