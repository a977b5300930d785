// How long the next substep is: as long as the CFL bound and the tolerance allow, fitted to what is left of the advance. And what the first substep of a
// block does for all of it.
#ifndef RILL_STEP_PLAN_GLSL
#define RILL_STEP_PLAN_GLSL
// The step in which the fastest particle, going on accelerating, moves no farther than cfl allows: speed t + acceleration t^2 = reach.
float cflStep(float speed, float acceleration) {
  float reach = params.cfl * params.spacing;
  return min(params.maxStep, 2.0 * reach / (speed + sqrt(speed * speed + 4.0 * acceleration * reach) + 1.0e-20));
}

// The step that the tolerance asks for, from the error of the step that was taken: over the square of the step it hardly depends on it.
// It moves slowly: what a long step left to correct is a kick in a short one. In calm fluid it follows a mean over many steps, since a step that
// follows each wave of pressure stiffens the fluid where it is compressed, and feeds the wave.
float tolerableStep(inout FluidControl c, float error) {
  if (params.tolerance <= 0.0) return params.maxStep;
  if (c.errorRate == 0.0) c.errorRate = params.tolerance / (c.desiredStep * c.desiredStep);
  float now = max(error, 1.0e-9) / (c.step * c.step);
  c.errorRate = mix(c.errorRate, now, pow(params.calmShare, c.calmness));
  return clamp(sqrt(params.tolerance / c.errorRate), 0.995 * c.desiredStep, 1.002 * c.desiredStep);
}

// The tolerance gives way before time has to be dropped: no shorter than what lets the substeps that are left finish the advance. cfl does not.
float plannedStep(FluidControl c, float tolerable, float cflBound) {
  float left = float(max(params.maxSubsteps, c.substeps + 1u) - c.substeps);
  return min(max(tolerable, 1.01 * c.timeLeft / left), cflBound);
}

// The advance's rest in equal substeps of about `wanted` seconds: a piece may be a quarter longer, so that the end of an advance never asks for a sliver.
float fittedStep(float rest, float wanted) {
  return rest / max(ceil(rest / wanted - 0.25), 1.0);
}

// Noise is damped, and pairs are parted by the artificial pressure, in the first substep of a block, by as much as the time since the last one asks for.
void planBlock(inout FluidControl c, bool blockStart) {
  c.calming = 0.0;
  c.parting = 0.0;
  c.blockTime += c.step;
  if (!blockStart) return;
  c.calming = min(params.calmingRate * c.calmness * c.blockTime, kMaxCalming);
  c.parting = min(params.tensileRate * c.blockTime, params.tensileMost / c.blockTime) * c.step;
  c.blockTime = 0.0;
}
#endif
