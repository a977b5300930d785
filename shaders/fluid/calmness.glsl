// How hard the solver may push, and what damps particle noise: what a flow needs would keep a still tank boiling. See ARCHITECTURE.md,
// "Calm water".
#ifndef RILL_CALMNESS_GLSL
#define RILL_CALMNESS_GLSL
// From the fastest particle's speed, the gains of the next substep.
void setGains(inout FluidControl c) {
  float share = params.roughSpeed > 0.0 ? min(c.speed / params.roughSpeed, 1.0) : 1.0, squared = share * share;
  c.calmness = 1.0 - squared * squared;
  c.relaxation = c.nextRelaxation;
  c.warmGain = c.nextWarmGain;
  c.nextRelaxation = mix(params.roughRelaxation, params.calmRelaxation, c.settling > 0u ? 0.0 : c.calmness);  // without time corrections are no speeds
  c.nextWarmGain = mix(params.roughWarmGain, params.calmWarmGain, c.calmness);
}
#endif
