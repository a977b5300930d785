// Relaxation, warm-start gain and noise damping between fluid at rest and in motion: the gains of a
// flow would add energy to a still tank. See docs/notes/noise-damping.md.
#ifndef RILL_GAINS_GLSL
#define RILL_GAINS_GLSL
#include "fluid/stability.glsl"
// From the fastest particle's speed, the gains of the next substep.
void setGains(inout FluidControl c) {
  float moving = motionSpeed(c.head), share = moving > 0.0 ? min(c.speed / moving, 1.0) : 1.0, squared = share * share;
  c.restFraction = 1.0 - squared * squared;
  c.relaxation = c.nextRelaxation;
  c.warmGain = c.nextWarmGain;
  // settling corrections add no velocity
  c.nextRelaxation = mix(params.relaxationInMotion, params.relaxationAtRest, c.nextPhase == kPhaseSettling ? 0.0 : c.restFraction);
  c.nextWarmGain = mix(params.warmGainInMotion, warmGainAtRest(c.head), c.restFraction);
}
#endif
