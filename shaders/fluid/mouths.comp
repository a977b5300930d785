#version 460
// Keeps fluid out of the place of the layer that leaves a mouth next, so that it is born without overlaps, under fluid too: the mouth is a
// piston, whose face moves with the flow from where the last layer was born to where the next one will be, and with the mouth.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "shared/arrays.glsl"
#include "shared/flow_records.h"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 3) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 4) writeonly buffer PredictionBlock { vec4 prediction[]; };
READ_FLOAT4(5, warmAcceleration)
layout(std430, binding = 6) readonly buffer EmitterBlock { EmitterRecord emitters[]; };
layout(std430, binding = 7) readonly buffer KeyframeBlock { KeyframeRecord keyframes[]; };
layout(std430, binding = 8) readonly buffer SumsBlock { FluidSums sums; };
READ_UINT(9, nearMouths)
layout(std430, binding = 10) readonly buffer MouthPointBlock { vec2 mouthPoints[]; };
#include "fluid/mouth_frame.glsl"
#include "fluid/mouth_points.glsl"
#include "fluid/open_mouths.glsl"

// The shortest displacement out of the piston; 0 if x is not in it.
vec3 displacementOut(uint e, MouthFrame frame, float phase, vec3 x) {
  vec3 normal = frame.normal, across = frame.across, up = frame.up, from = x - centerOf(frame.pose);
  float thickness = min(emitters[e].speed / emitters[e].rate, params.spacing);  // of a mouth of one particle it may be much more
  float along = dot(from, normal), forward = phase * thickness - along, backward = along + thickness;
  vec2 side = vec2(dot(from, across), dot(from, up)), limit = vec2(emitters[e].halfAcross, emitters[e].halfUp);
  bool isDisc = emitters[e].shape == kDiscMouth, isRect = emitters[e].shape == kRectMouth;
  limit += isRect ? 0.5 * params.spacing : params.spacing;  // centers of a layer reach the rim of a disc and of a mesh
  vec2 beside = limit - abs(side);
  float radius = length(side), aside = isDisc ? limit.x - radius : min(beside.x, beside.y);
  float shortest = min(min(forward, backward), aside);
  if (shortest <= 0.0) return vec3(0.0);
  if (emitters[e].shape == kMeshMouth) return mat3(across, up, normal) * displacementFromPoints(e, side, forward, backward);
  if (shortest == forward) return forward * normal;
  if (shortest == backward) return -backward * normal;
  if (isDisc) return aside / max(radius, 1.0e-20) * (side.x * across + side.y * up);
  return beside.x < beside.y ? (side.x < 0.0 ? -beside.x : beside.x) * across : (side.y < 0.0 ? -beside.y : beside.y) * up;
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearMouths || control.phase != kPhaseAdvancing) return;
  uint i = nearMouthsAt(n);
  if (i >= control.solved) return;
  vec3 x = position[i].xyz, v = velocity[i].xyz;
  if (!isActive(x)) return;
  bool pushed = false;
  for (uint e = 0u; e < params.emitterCount; ++e) {
    OpenMouth mouth;
    if (!isOpen(e, 0.0, mouth)) continue;
    MouthFrame frame = mouthFrame(e, control.timeHigh + control.timeLow);
    vec3 out_ = displacementOut(e, frame, mouth.phase, x);
    float depth = length(out_);
    if (depth <= 1.0e-5 * params.spacing) continue;
    vec3 direction = out_ / depth, own = velocityAt(frame.pose, x);
    float face = max(dot(direction, frame.normal) * emitters[e].speed, 0.0) + dot(direction, own);
    x += direction * min(depth, 2.0 * (emitters[e].speed + length(own)) * control.step);  // where it opens in fluid, at a bounded speed
    v += direction * max(face - dot(v, direction), 0.0);
    pushed = true;
  }
  if (!pushed) return;
  x = insideWalls(x);
  position[i].xyz = x;
  velocity[i].xyz = v;
  vec3 next = insideWalls(predicted(x, v, keptWarmAcceleration(warmAccelerationAt(i))));
  prediction[i] = vec4(next, withFluid(0.0, fluidOfPosition(position[i])));
}
