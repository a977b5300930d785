#version 460
// Births: the particles of the layers that are due, behind the others. Each has left the mouth where that was at its own time, with
// the mouth's velocity in addition, and has gone on in free fall since. One whose place is in a solid or behind a wall is born inactive,
// and taken out by the sort that follows.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "shared/arrays.glsl"
#include "shared/flow_records.h"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer EmitterBlock { EmitterRecord emitters[]; };
layout(std430, binding = 3) buffer FlowBlock { FlowRecord flow; };
layout(std430, binding = 4) readonly buffer MouthPointBlock { vec2 mouthPoints[]; };
layout(std430, binding = 5) writeonly buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 6) writeonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 7) writeonly buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 8) writeonly buffer WarmBlock { float warm[]; };
layout(std430, binding = 9) writeonly buffer IdBlock { uint id[]; };
layout(std430, binding = 10) readonly buffer SolidBlock { SolidRecord solids[]; };
READ_UINT(11, meshWord)
layout(std430, binding = 12) writeonly buffer WarmAccelerationBlock { vec4 warmAcceleration[]; };
layout(std430, binding = 13) readonly buffer KeyframeBlock { KeyframeRecord keyframes[]; };
layout(std430, binding = 14) writeonly buffer ConcentrationBlock { vec4 concentration[]; };
#define MESH_WORDS
#include "shared/shape.glsl"
#include "fluid/mouth_frame.glsl"

bool insideSolid(vec3 x) {
  for (uint k = 0u; SOLIDS && k < params.solidCount; ++k) {
    vec3 normal;
    if (isBeyond(centerOf(solids[k].pose), solids[k].radius, x, params.spacing)) continue;  // a sheet is thicker than its bounds
    if (surfaceDistance(solids[k].shape, localPoint(solids[k].pose, x), normal) < 0.0) return true;
  }
  return false;
}

// The emitter of a candidate: the last one that begins at it or before, and has candidates.
uint emitterOf(uint candidate) {
  uint found = 0u;
  for (uint e = 1u; e < params.emitterCount; ++e)
    if (emitters[e].firstCandidate <= candidate) found = e;
  return found;
}

void main() {
  uint born = flatInvocation();
  if (born >= flow.candidates) return;
  uint e = emitterOf(born), k = born - emitters[e].firstCandidate, points = emitters[e].points;
  uint later = emitters[e].waiting + emitters[e].layers - 1u - k / points;  // layers that left after its own
  float age = emitters[e].age + float(later) * emitters[e].interval;
  vec2 place = mouthPoints[emitters[e].firstPoint + k % points];
  MouthFrame frame = mouthFrame(e, control.timeHigh + (control.timeLow - age));
  vec3 mouth = centerOf(frame.pose) + place.x * frame.across + place.y * frame.up;
  vec3 v = emitters[e].speed * frame.normal + velocityAt(frame.pose, mouth);
  vec3 x = mouth + age * (v + 0.5 * age * gravity());
  v += age * gravity();
  if (insideSolid(x)) x = mouth;  // it would have met the solid

  bool walled = any(lessThan(mouth, wallsLow())) || any(greaterThan(mouth, wallsHigh()));
  bool blocked = walled || insideSolid(mouth);
  uint i = flow.firstBorn + born;
  if (blocked) {
    x = vec3(kInactivePosition);
    v = vec3(0.0);
    atomicOr(emitters[e].blocked, kCovered);
  } else {
    x = insideWalls(x);
    atomicAdd(emitters[e].emitted, 1u);
    atomicAdd(flow.emitted, 1u);
    if (FLUIDS) atomicAdd(flow.emittedOf[emitters[e].fluid], 1u);
  }
  position[i] = vec4(x, storedFluid(emitters[e].fluid));
  velocity[i] = vec4(v, 1.0);
  // Its fluid follows at the sort.
  prediction[i] = vec4(blocked ? x : insideWalls(predicted(x, v, vec3(0.0))), 0.0);
  if (WARM) warm[i] = 0.0;
  if (WARM) warmAcceleration[i] = vec4(0.0);
  if (DIFFUSES) concentration[i] = unmixed(emitters[e].fluid);
  id[i] = flow.nextId - flow.candidates + born;
}
