// Relaxation, warm-start gain and noise damping between fluid at rest and in motion: the gains of a
// flow would add energy to a still tank. See docs/notes/noise-damping.md. Needs `params` and a `control` to write.
#ifndef RILL_GAINS_GLSL
#define RILL_GAINS_GLSL
#include "fluid/stability.glsl"
// From the fastest particle's speed, the gains of the next substep.
void setGains() {
  float moving = motionSpeed(control.head), share = moving > 0.0 ? min(control.speed / moving, 1.0) : 1.0, squared = share * share;
  control.restFraction = 1.0 - squared * squared;
  control.relaxation = control.nextRelaxation;
  control.warmGain = control.nextWarmGain;
  float rest = control.nextPhase == kPhaseSettling ? 0.0 : control.restFraction;  // settling corrections add no velocity
  control.nextRelaxation = mix(params.relaxationInMotion, params.relaxationAtRest, rest);
  control.nextWarmGain = mix(params.warmGainInMotion, warmGainAtRest(control.head), control.restFraction);
}
#endif
