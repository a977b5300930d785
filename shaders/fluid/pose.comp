#version 460
// Where the solids are, and how fast they move, at the end of the substep at hand: by their
// keyframes; driven ones move and turn evenly from their pose at the begin of the advance to that
// at its end. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/solid_records.h"
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 3) readonly buffer KeyframeBlock { KeyframeRecord keyframes[]; };
#include "shared/keyframes.glsl"

PoseRecord drivenPose(uint first) {
  KeyframeRecord from = keyframes[first], to = keyframes[first + 1u];
  vec3 start = vec3(from.x, from.y, from.z), end = vec3(to.x, to.y, to.z);
  vec4 rotation = vec4(to.rotationX, to.rotationY, to.rotationZ, to.rotationW);
  if (!(to.at > 0.0)) return poseOf(end, rotation, vec3(0.0), vec3(0.0));
  float since = clamp(to.at - (control.timeLeft - ahead()), 0.0, to.at);
  vec3 angular = vec3(from.turnX, from.turnY, from.turnZ) / to.at;
  // at the end exactly what the host says, from where it goes on
  if (since < to.at) rotation = turnedFor(vec4(from.rotationX, from.rotationY, from.rotationZ, from.rotationW), angular, since);
  return poseOf(mix(start, end, since / to.at), rotation, (end - start) / to.at, angular);
}

void main() {
  float time = control.timeHigh + (control.timeLow + ahead());
  for (uint n = gl_LocalInvocationID.x; n < params.solidCount; n += gl_WorkGroupSize.x) {
    SolidRecord solid = solids[n];
    if (solid.driven != 0u)
      solids[n].pose = drivenPose(solid.firstKey);
    else if (solid.keyCount > 0u)
      solids[n].pose = keyframedPose(solid.base, solid.firstKey, solid.keyCount, time);
  }
}
