// What follows from a density pass: accounts for the substep and plans the next ones. Every decision that
// depends on the simulation's state is made here, on the device, so that no result depends on when the
// host reads. Needs `params`, `sums` and `gravityChanges`, and a `control` to write.
#ifndef RILL_CONTROL_GLSL
#define RILL_CONTROL_GLSL
#include "fluid/gains.glsl"
#include "fluid/step_plan.glsl"
#include "fluid/sleep.glsl"

// Settling: particles that overlap at the start are separated by position corrections without a
// step in time, which add no velocity.
void settle(float error, float errorMax) {
  float enough = params.tolerance > 0.0 ? min(params.tolerance, 0.001) : 0.001;
  // What is left becomes speed in the first step: a small part of what a correction may always
  // add. Rounding leaves 1e-6.
  if (params.minSpeedGain > 0.0) enough = min(enough, max(0.05 * params.minSpeedGain * control.nextStep / params.spacing, 2.0e-6));
  // small enough for the initial pressure to be solved
  float rest = params.initialPressureIterations > 0u ? min(0.5 * enough, params.initialPressureErrorLimit) : 0.5 * enough;
  bool apart = error <= rest && errorMax <= 20.0 * enough;
  if (!apart && control.phaseLeft > 1u) {
    setNextPhase(kPhaseSettling, control.phaseLeft - 1u);
  } else if (params.initialPressureIterations > 0u && error <= params.initialPressureErrorLimit) {
    setNextPhase(kPhaseInitialPressure, params.initialPressureIterations);
    control.nextStep = control.warmStep = params.initialPressureStep;
  } else {
    setNextPhase(kPhaseAdvancing, 0u);
  }
  setGains();
  control.travel += 0.1 * params.spacing;
  if (control.travel > params.travelLimit) control.listState = kListDue;
}

// Initial pressure: the hydrostatic equilibrium of the start, solved in a step of its own: see
// docs/notes/initial-pressure.md.
void iteratePressure() {
  control.warmStep = control.nextStep;
  if (control.phaseLeft > 1u) {
    control.phaseLeft -= 1u;
  } else {
    setNextPhase(kPhaseAdvancing, 0u);
    control.nextStep = fittedStep(control.timeLeft, control.desiredStep);
  }
  setGains();
}

// Accounts for the density pass of an iteration, 0 the first, and plans on. Returns the parity that
// the commands are to be switched by.
uint accountSubstep(uint iteration, uint parity, bool blockStart) {
  bool first = iteration == 0u;
  // Without a first substep, the last correction's command was still on.
  if ((first ? control.running : control.again) == 0u) return first ? kNoSubstep : kKeepCommands;

  float errorMax = uintBitsToFloat(sums.errorMax);
  float error = (float(sums.errorHigh) * 4294967296.0 + float(sums.errorLow)) * kErrorUnit / float(max(movingParticles(), 1u));
  bool converged = params.tolerance > 0.0 && error <= params.tolerance && errorMax <= 100.0 * params.tolerance;
  bool again = iteration + 1u < params.iterations && !converged;
  control.iterations += 1u;
  control.executedIterations += 1u;
  if (first) control.executedSubsteps += 1u;
  sums.errorLow = 0u;
  sums.errorHigh = 0u;
  sums.errorMax = 0u;
  sums.viscosityBound = 0u;
  sums.viscosityCapped = 0u;
  sums.diffusionRow = 0u;

  if (first) control.phase = control.nextPhase;
  if (first && control.phase != kPhaseAdvancing) {
    again = false;
    control.step = 0.0;
    control.noiseDamping = 0.0;
    control.coherenceKnown = 0u;
    control.diffusion = 0.0;
    control.artificialPressure = 0.0;
    if (control.phase == kPhaseSettling) settle(error, errorMax);
    else iteratePressure();
  } else if (first) {
    control.step = control.nextStep;
    control.error = error;
    control.speed = max(uintBitsToFloat(sums.speedMax), control.emitterSpeed);
    control.flowSpeed = min(control.speed, kFlowTimes * sqrt(meanMotion()));
    sums.speedMax = 0u;
    control.bodySpeed = uintBitsToFloat(sums.bodySpeed);
    sums.bodySpeed = 0u;
    float solidSpeed = max(control.solidSpeed, control.bodySpeed);
    setGains();
    planNoiseDamping(blockStart);
    planDiffusion(blockStart);
    control.artificialPressure = min(params.tensileRate * control.step * control.step, params.tensileLimit);
    control.warmStep = control.step;
    control.timeLeft -= control.step;
    control.substeps += 1u;
    addTime(control.step);
    control.travel += (control.speed + solidSpeed) * control.step;
    bool gravityChanged = gravityAt();
    vec3 gravity = vec3(control.gravityX, control.gravityY, control.gravityZ);
    float acceleration = length(gravity);
    float tolerable = movingParticles() > 0u ? tolerableStep(error) : control.desiredStep;  // else there is no error to go by
    control.desiredStep = plannedStep(tolerable, cflStep(acceleration, control.head));
    accountRest(error, gravityChanged);
    control.regionTime += control.step;
    noticeCauses();
    if (control.timeLeft < 1.0e-4 * control.step) control.timeLeft = 0.0;
    if (control.timeLeft > 0.0 && control.substeps >= params.maxSubsteps) {
      control.timeDropped += control.timeLeft;
      control.timeLeft = 0.0;
    }
    control.nextStep = control.timeLeft > 0.0 ? fittedStep(control.timeLeft, control.desiredStep) : control.desiredStep;
    float nextTravel = control.travel + (control.speed + solidSpeed + acceleration * control.nextStep) * control.nextStep;
    control.emissionWait -= control.step;
    if (nextTravel > travelLimit() || control.emissionWait <= 0.0 || regionsAreDue()) control.listState = kListDue;
  }

  if (first) sums.motionLow = sums.motionHigh = sums.stoppedLow = sums.stoppedHigh = sums.fast = 0u;
  if (first && control.noiseDamping > 0.0) control.executedNoiseDampings += 1u;
  control.running = control.timeLeft > 0.0 && control.listState == kListValid ? 1u : 0u;
  control.again = again ? 1u : 0u;
  return parity;
}
#endif
