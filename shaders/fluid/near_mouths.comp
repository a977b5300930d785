#version 460
// Lists the particles that an emitter's mouth may act on before the next list build.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
#include "shared/flow_records.h"
#include "shared/neighbor_list.h"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, position)
layout(std430, binding = 3) readonly buffer EmitterBlock { EmitterRecord emitters[]; };
layout(std430, binding = 4) readonly buffer KeyframeBlock { KeyframeRecord keyframes[]; };
layout(std430, binding = 5) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 6) buffer HeadBlock { uint listHead[]; };
layout(std430, binding = 7) writeonly buffer NearMouthsBlock { uint nearMouths[]; };
#include "fluid/mouth_frame.glsl"

// Whether x is near the mouth: the host may open it at any time. nearLimit is for the travel of one of the two, and from the surface; the
// mouth's own travel, half a square of its lattice and half a layer come to two spacings more.
bool isNear(uint e, vec3 x) {
  MouthFrame frame = mouthFrame(e, control.timeHigh + control.timeLow);
  vec3 from = x - centerOf(frame.pose);
  float along = dot(from, frame.normal), reach = params.nearLimit + 2.0 * params.spacing;
  if (along < -reach || along > reach + 1.5 * kThickestLayer * params.spacing) return false;
  vec2 side = abs(vec2(dot(from, frame.across), dot(from, frame.up)));
  return side.x < emitters[e].halfAcross + reach && side.y < emitters[e].halfUp + reach;
}

void main() {
  uint i = flatInvocation();
  if (i >= control.count) return;
  vec3 x = positionAt(i).xyz;
  // Mouths keep regions awake that they reach.
  bool listed = isActive(x) && !(REGIONS && (listHead[i] & kAsleepBit) != 0u), near = false;
  for (uint e = 0u; e < params.emitterCount && listed && !near; ++e) near = isNear(e, x);
  if (!near) return;
  nearMouths[atomicAdd(sums.nearMouths, 1u)] = i;
  listHead[i] |= kNearMouthsBit;
}
