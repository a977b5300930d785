// Relaxation, warm-start gain and noise damping between fluid at rest and in motion: the gains of a
// flow would add energy to a still tank. See docs/notes/noise-damping.md.
#ifndef RILL_GAINS_GLSL
#define RILL_GAINS_GLSL
// From the fastest particle's speed, the gains of the next substep.
void setGains(inout FluidControl c) {
  float share = params.motionSpeed > 0.0 ? min(c.speed / params.motionSpeed, 1.0) : 1.0, squared = share * share;
  c.restFraction = 1.0 - squared * squared;
  c.relaxation = c.nextRelaxation;
  c.warmGain = c.nextWarmGain;
  // settling corrections add no velocity
  c.nextRelaxation = mix(params.relaxationInMotion, params.relaxationAtRest, c.nextPhase == kPhaseSettling ? 0.0 : c.restFraction);
  c.nextWarmGain = mix(params.warmGainInMotion, params.warmGainAtRest, c.restFraction);
}
#endif
