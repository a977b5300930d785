#version 460
// Particles in a drain, or beyond an open side that removes, become inactive and are counted: nothing is near them any more, and the next
// rebuild takes them out.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "shared/flow_records.h"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 3) writeonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 4) writeonly buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 5) writeonly buffer WarmBlock { float warm[]; };
layout(std430, binding = 6) writeonly buffer WarmAccelerationBlock { vec4 warmAcceleration[]; };
layout(std430, binding = 7) buffer DrainBlock { DrainRecord drains[]; };
layout(std430, binding = 8) buffer FlowBlock { FlowRecord flow; };

bool drainHolds(uint k, vec3 x) {
  vec3 low = vec3(drains[k].lowX, drains[k].lowY, drains[k].lowZ), high = vec3(drains[k].highX, drains[k].highY, drains[k].highZ);
  bool open = (control.timeHigh - drains[k].from) + control.timeLow > 0.0 && (control.timeHigh - drains[k].until) + control.timeLow <= 0.0;
  bool inside = drains[k].sphere != 0u ? dot(x - low, x - low) <= high.x * high.x
                                       : all(greaterThanEqual(x, low)) && all(lessThanEqual(x, high));
  return open && inside;
}

// Sides as bits -x +x -y +y -z +z.
bool hasLeft(vec3 x) {
  vec3 low = vec3(params.boundLowX, params.boundLowY, params.boundLowZ);
  vec3 high = vec3(params.boundHighX, params.boundHighY, params.boundHighZ);
  uint beyond = 0u;
  for (uint a = 0u; a < 3u; ++a) beyond |= uint(x[a] < low[a]) << (2u * a) | uint(x[a] > high[a]) << (2u * a + 1u);
  return (beyond & params.openRemoves) != 0u;
}

void main() {
  uint i = flatInvocation();
  if (i >= control.solved || control.phase != kPhaseAdvancing) return;
  vec3 x = position[i].xyz;
  if (!isActive(x)) return;
  uint drain = 0u;
  while (drain < params.drainCount && !drainHolds(drain, x)) ++drain;  // the first takes
  if (drain < params.drainCount) {
    atomicAdd(drains[drain].drained, 1u);
    atomicAdd(flow.drained, 1u);
    if (FLUIDS) atomicAdd(flow.drainedOf[fluidOfPosition(position[i])], 1u);
  } else if (hasLeft(x)) {
    atomicAdd(flow.left, 1u);
    if (FLUIDS) atomicAdd(flow.leftOf[fluidOfPosition(position[i])], 1u);
  } else {
    return;
  }
  position[i] = vec4(vec3(kInactivePosition), 0.0);
  velocity[i] = vec4(0.0, 0.0, 0.0, 1.0);
  prediction[i] = vec4(vec3(kInactivePosition), 0.0);
  if (WARM) warm[i] = 0.0;
  if (WARM) warmAcceleration[i] = vec4(0.0);
}
