#version 460
// Loads on solids and pressures at probes while the fluid sleeps: those of the last advance go on. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/pose.glsl"
#include "shared/pressure_probe.h"
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 3) buffer SolidLoadBlock { SolidLoadRecord solidLoads[]; };
layout(std430, binding = 4) readonly buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 5) buffer PressureProbeBlock { PressureProbeRecord pressureProbes[]; };
#include "fluid/solid_impulses.glsl"

void main() {
  float time = control.timeAsleep;
  if (time <= 0.0) return;
  for (uint n = gl_LocalInvocationID.x; LOADS && n < params.solidCount; n += gl_WorkGroupSize.x) {
    endAdvance(n);  // one that was cut short, if any
    for (uint c = 0u; c < kLoadComponents; ++c) {
      addImpulse(n, c, time * solidLoads[n].mean[c]);
      solidLoads[n].advance[c] = 0.0;
    }
  }
  for (uint n = gl_LocalInvocationID.x; n < params.pressureProbes; n += gl_WorkGroupSize.x) {
    PressureProbeRecord p = pressureProbes[n];
    precise float high = p.integralHigh, low = p.integralLow + time * p.mean;
    precise float sum = high + low, rest = (high - sum) + low;
    pressureProbes[n].integralHigh = sum;
    pressureProbes[n].integralLow = rest;
  }
}
