// How hard the solver may push, and what damps particle noise: what a flow needs would keep a still tank boiling. See ARCHITECTURE.md,
// "Calm water".
#ifndef RILL_CALMNESS_GLSL
#define RILL_CALMNESS_GLSL
void setGains(inout FluidControl c) {
  float share = min(c.speed / max(params.roughSpeed, 1.0e-20), 1.0), squared = share * share;
  c.calmness = 1.0 - squared * squared;
  c.relaxation = mix(params.roughRelaxation, params.calmRelaxation, c.calmness);
  c.warmGain = mix(params.roughWarmGain, params.calmWarmGain, c.calmness);
}

// Noise is damped now and then, by as much as the time since then asks for: `calms` says that the pass is there.
void planCalming(inout FluidControl c, bool calms) {
  c.uncalmed += c.step;
  c.calming = 0.0;
  if (!calms) return;
  c.calming = min(params.calmingRate * c.calmness * c.uncalmed, 0.5);
  c.uncalmed = 0.0;
}
#endif
