#version 460
// Loads of the fluid on solids from the sums of the substep that ends, which begin anew. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/solid_loads.h"
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 3) buffer SolidLoadBlock { SolidLoadRecord solidLoads[]; };

// The sum at `word`, in units; it begins anew.
float takeSum(uint word) {
  uint low = solidSums[word], high = solidSums[word + 1u];
  solidSums[word] = 0u;
  solidSums[word + 1u] = 0u;
  bool negative = high >= 0x80000000u;
  if (negative) {
    low = ~low + 1u;
    high = ~high + uint(low == 0u);
  }
  float size = float(high) * 4294967296.0 + float(low);
  return negative ? -size : size;
}

// N s^2 or N m s^2, from units: the opposite of what particles got. In an order in which no product is denormal.
float reaction(uint component, float units) {
  float displacement = units * kDisplacementUnits * params.spacing;
  return -params.particleMass * (component < 3u ? displacement : displacement * params.loadLever);
}

void addImpulse(uint n, uint c, float impulse) {
  precise float high = solidLoads[n].impulseHigh[c], low = solidLoads[n].impulseLow[c] + impulse;
  precise float sum = high + low, rest = (high - sum) + low;
  solidLoads[n].impulseHigh[c] = sum;
  solidLoads[n].impulseLow[c] = rest;
  solidLoads[n].advance[c] += impulse;
}

void endAdvance(uint n) {
  if (solidLoads[n].advanceTime <= 0.0) return;
  for (uint c = 0u; c < kLoadComponents; ++c) {
    solidLoads[n].mean[c] = solidLoads[n].advance[c] / solidLoads[n].advanceTime;
    solidLoads[n].advance[c] = 0.0;
  }
  solidLoads[n].advanceTime = 0.0;
}

void main() {
  bool advances = control.phase == kPhaseAdvancing, ends = control.timeLeft <= 0.0;
  for (uint n = gl_LocalInvocationID.x; n < params.solidCount; n += gl_WorkGroupSize.x) {
    if (advances && control.substeps == 1u) endAdvance(n);  // one that was cut short, if any
    if (advances) solidLoads[n].advanceTime += control.step;
    for (uint c = 0u; c < kLoadComponents; ++c) {
      float solve = reaction(c, takeSum(n * kSolidSumWords + kSolveSums + 2u * c));
      float warm = reaction(c, takeSum(n * kSolidSumWords + kWarmSums + 2u * c));
      if (advances) addImpulse(n, c, solve / control.step + solidLoads[n].warm[c] * control.step);
      solidLoads[n].warm[c] = control.warmStep > 0.0 ? warm / (control.warmStep * control.warmStep) : 0.0;
    }
    if (advances && ends) endAdvance(n);
  }
}
