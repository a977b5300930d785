#version 460
// The fluid falls asleep: what is left of its motion ends. Multipliers and accelerations of the warm start stay, so that waking is no jolt.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/body_records.h"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 3) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 4) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 5) buffer SumsBlock { FluidSums sums; };
#include "shared/pose.glsl"

PoseRecord still(PoseRecord s) { return poseOf(centerOf(s), rotationOf(s), vec3(0.0), vec3(0.0)); }

void main() {
  uint i = flatInvocation();
  if (i == 0u) {
    sums.speedMax = 0u;
    sums.bodySpeed = 0u;
    sums.motionLow = 0u;
    sums.motionHigh = 0u;
    sums.stoppedLow = 0u;
    sums.stoppedHigh = 0u;
    sums.fast = 0u;
  }
  if (i < kFluidGroup)
    for (uint n = i; n < params.bodyCount; n += kFluidGroup) {
      bodies[n].state = still(bodies[n].state);
      solids[bodies[n].solid].pose = still(solids[bodies[n].solid].pose);
    }
  if (i < control.count) velocity[i].xyz = vec3(0.0);
}
