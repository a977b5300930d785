// Adds impulses to the loads of solids, and ends the means of an advance. Needs `params`, and the storage array `solidLoads`.
#ifndef RILL_SOLID_IMPULSES_GLSL
#define RILL_SOLID_IMPULSES_GLSL
#include "fluid/solid_sums.glsl"

// N s^2 or N m s^2: the opposite of what particles got.
float reaction(uint component, uint first) {
  return -params.particleMass * toDisplacement(component, takeSum(first + 2u * component));
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
#endif
