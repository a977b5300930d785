// Relaxation, warm-start gain and noise damping between fluid at rest and in motion: the gains of a
// flow would add energy to a still tank. See docs/notes/noise-damping.md. Needs `params`, `sums` and a
// `control` to write.
#ifndef RILL_GAINS_GLSL
#define RILL_GAINS_GLSL
#include "fluid/stability.glsl"
// Particles that substeps move.
uint movingParticles() { return control.count - min(sums.asleep, control.count); }

// Mean square of their speeds, m^2/s^2, from a sum of 64 bits.
float meanMotion(uint high, uint low) {
  float sum = (float(high) * 4294967296.0 + float(low)) * kMotionUnit;
  return sum / float(max(movingParticles(), 1u)) * params.layerHead;
}

// After the last correction.
float meanMotion() { return meanMotion(sums.motionHigh, sums.motionLow); }

// After solids have acted, too.
float meanMotionLeft() {
  uint low = sums.motionLow - sums.stoppedLow, borrow = uint(sums.motionLow < sums.stoppedLow);
  bool less = sums.motionHigh < sums.stoppedHigh + borrow;  // by rounding
  return less ? 0.0 : meanMotion(sums.motionHigh - sums.stoppedHigh - borrow, low);
}

// m that the fastest particle may move before the list is rebuilt. An old list has the neighbors that a particle leaves, but not all that
// it approaches, which accelerates particles that slide past others: see docs/notes/neighbor-list.md.
float travelLimit() { return params.travelLimit * mix(1.0, kTravelAtRest, control.restFraction); }

// From the speed of the flow, the gains of the next substep.
void setGains() {
  float moving = motionSpeed(control.head), share = moving > 0.0 ? min(control.flowSpeed / moving, 1.0) : 1.0, squared = share * share;
  control.restFraction = 1.0 - squared * squared;
  control.relaxation = control.nextRelaxation;
  control.warmGain = control.nextWarmGain;
  float rest = control.nextPhase == kPhaseSettling ? 0.0 : control.restFraction;  // settling corrections add no velocity
  control.nextRelaxation = mix(params.relaxationInMotion, params.relaxationAtRest, rest);
  control.nextWarmGain = mix(params.warmGainInMotion, warmGainAtRest(control.head), control.restFraction);
}
#endif
