// How long the next substep is: as long as the CFL bound and the tolerance allow, fitted to what is
// left of the advance. And what the first substep of a block does for all of it. Needs `params` and a
// `control` to write.
#ifndef RILL_STEP_PLAN_GLSL
#define RILL_STEP_PLAN_GLSL
#include "fluid/stability.glsl"
// The step in which the fastest particle, going on accelerating, moves no farther than cfl allows:
// speed t + acceleration t^2 = reach. And no longer than the longest stable one.
float cflStep(float acceleration, float head) {
  float speed = max(control.speed, control.emitterSpeed) + max(params.solidSpeedInCfl * control.solidSpeed, control.bodySpeed);
  float reach = params.cfl * params.spacing;
  return min(longestStep(head), 2.0 * reach / (speed + sqrt(speed * speed + 4.0 * acceleration * reach) + 1.0e-20));
}

// The step that meets the tolerance, from the error of the last one: error / step^2 hardly depends
// on the step. It changes slowly, since an error left by a long step becomes a velocity jump in a
// short one. In fluid at rest it follows a mean of means over many steps: a step that follows each
// pressure wave would amplify it, and so would one mean, which lags it by a quarter of its period.
// See docs/notes/noise-damping.md (4).
float tolerableStep(float error) {
  if (params.tolerance <= 0.0) return longestStep(control.head);
  if (control.errorRate == 0.0) control.errorRate = params.tolerance / (control.desiredStep * control.desiredStep);
  float now = max(error, 1.0e-9) / (control.step * control.step);
  float share = pow(errorRateShareAtRest(control.head), control.restFraction);
  control.errorRate = mix(control.errorRate, now, share);
  float wanted = mix(control.desiredStep, sqrt(params.tolerance / control.errorRate), share);
  return clamp(wanted, 0.995 * control.desiredStep, 1.002 * control.desiredStep);
}

// Meeting max_substeps has priority over the tolerance: the step is long enough for the remaining
// substeps to finish the advance. cfl has priority over both.
float plannedStep(float tolerable, float cflBound) {
  float left = float(max(params.maxSubsteps, control.substeps + 1u) - control.substeps);
  return min(max(tolerable, 1.01 * control.timeLeft / left), cflBound);
}

// The rest of the advance in equal substeps of about `wanted` seconds, up to a quarter longer, so
// that the last one is never very short.
float fittedStep(float rest, float wanted) {
  return rest / max(ceil(rest / wanted - 0.25), 1.0);
}

void setNextPhase(uint phase, uint left) {
  control.nextPhase = phase;
  control.phaseLeft = left;
}

// Noise damping acts in the first substep of a block, for the time since the last one.
void planNoiseDamping(bool blockStart) {
  control.coherenceKnown = uint(!blockStart && (control.noiseDamping > 0.0 || control.coherenceKnown != 0u));
  control.noiseDamping = 0.0;
  control.blockTime += control.step;
  if (!blockStart) return;
  control.noiseDamping = min(params.noiseDampingRate * control.restFraction * control.blockTime, kMaxNoiseDamping);
  control.blockTime = 0.0;
}

// So does diffusion.
void planDiffusion(bool blockStart) {
  control.diffusion = 0.0;
  if (params.maxDiffusionRate == 0.0) return;
  control.diffusionTime += control.step;
  if (!blockStart) return;
  control.diffusion = control.diffusionTime;
  control.diffusionTime = 0.0;
  control.executedDiffusions += 1u;
}
#endif
