#version 460
// Where the solids are, and how fast they move, at the end of the substep at hand: by their
// keyframes; driven ones go evenly from where they were at the begin of the advance to where they
// are to be at its end. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/solid_records.h"
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 3) readonly buffer KeyframeBlock { KeyframeRecord keyframes[]; };
#include "shared/keyframes.glsl"

PoseRecord drivenPose(PoseRecord base, uint first) {
  KeyframeRecord from = keyframes[first], to = keyframes[first + 1u];
  vec3 start = vec3(from.x, from.y, from.z), end = vec3(to.x, to.y, to.z);
  float share = to.at > 0.0 ? clamp((to.at - control.timeLeft + ahead()) / to.at, 0.0, 1.0) : 1.0;
  vec3 velocity = to.at > 0.0 ? (end - start) / to.at : vec3(0.0);
  return poseOf(centerOf(base) + mix(start, end, share), rotationOf(base), velocity, vec3(0.0));
}

void main() {
  float time = control.timeHigh + (control.timeLow + ahead());
  for (uint n = gl_LocalInvocationID.x; n < params.solidCount; n += gl_WorkGroupSize.x) {
    SolidRecord solid = solids[n];
    if (solid.driven != 0u)
      solids[n].pose = drivenPose(solid.base, solid.firstKey);
    else if (solid.keyCount > 0u)
      solids[n].pose = keyframedPose(solid.base, solid.firstKey, solid.keyCount, time);
  }
}
