#version 460
// Loads of the fluid on solids from the sums of the substep that ends, which begin anew. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/pose.glsl"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { LoadPush push; };
layout(std430, binding = 2) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 3) buffer SolidLoadBlock { SolidLoadRecord solidLoads[]; };
layout(std430, binding = 4) readonly buffer SolidBlock { SolidRecord solids[]; };
#include "fluid/solid_impulses.glsl"

void main() {
  bool advances = control.phase == kPhaseAdvancing, last = push.ends != 0u, ends = last && control.timeLeft <= 0.0;
  for (uint n = gl_LocalInvocationID.x; n < params.solidCount; n += gl_WorkGroupSize.x) {
    uint words = n * kSolidSumWords;
    if (advances && last && control.substeps == 1u) endAdvance(n);  // one that was cut short, if any
    if (advances && last) solidLoads[n].advanceTime += control.step;
    if (BODIES && last) solidLoads[n].stiffness = kStiffnessUnits * takeSum(words + kStiffnessSum);
    for (uint c = 0u; c < kLoadComponents; ++c) {
      float solve = reaction(c, words + kSolveSums);
      if (BODIES && advances) solidLoads[n].solve[c] = solve / control.step;
      if (advances) addImpulse(n, c, solve / control.step + (last ? solidLoads[n].warm[c] * control.step : 0.0));
      if (!last) continue;
      float warm = reaction(c, words + kWarmSums);
      solidLoads[n].warm[c] = control.warmStep > 0.0 ? warm / (control.warmStep * control.warmStep) : 0.0;
    }
    if (advances && ends && !NO_SLIP_SOLIDS && !TENSION) endAdvance(n);  // else what follows in the substep ends it
  }
}
