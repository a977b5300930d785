#version 460
// After a density pass: accounts for the substep, plans the next ones and enables the dispatch
// commands that follow. Every decision that depends on the simulation's state is made here, on the
// device, so that no result depends on when the host reads.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
layout(local_size_x = 1) in;
layout(push_constant) uniform Push { ControlPush push; };
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; };
layout(std430, binding = 2) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) readonly buffer GravityBlock { vec4 gravityChanges[]; };
#include "fluid/gains.glsl"
#include "fluid/step_plan.glsl"
#include "fluid/dispatch_commands.glsl"
#include "fluid/time.glsl"

// Settling: particles that overlap at the start are separated by position corrections without a
// step in time, which add no velocity.
void settle(inout FluidControl c, float error, float errorMax) {
  float enough = params.tolerance > 0.0 ? min(params.tolerance, 0.001) : 0.001;
  // What is left becomes speed in the first step: a small part of what a correction may always
  // add. Rounding leaves 1e-6.
  if (params.minSpeedGain > 0.0) enough = min(enough, max(0.05 * params.minSpeedGain * c.nextStep / params.spacing, 2.0e-6));
  // small enough for the initial pressure to be solved
  float rest = params.initialPressureIterations > 0u ? min(0.5 * enough, params.initialPressureErrorLimit) : 0.5 * enough;
  bool apart = error <= rest && errorMax <= 20.0 * enough;
  if (!apart && c.phaseLeft > 1u) {
    setNextPhase(c, kPhaseSettling, c.phaseLeft - 1u);
  } else if (params.initialPressureIterations > 0u && error <= params.initialPressureErrorLimit) {
    setNextPhase(c, kPhaseInitialPressure, params.initialPressureIterations);
    c.nextStep = c.warmStep = params.initialPressureStep;
  } else {
    setNextPhase(c, kPhaseAdvancing, 0u);
  }
  setGains(c);
  c.travel += 0.1 * params.spacing;
  if (c.travel > params.travelLimit) c.listState = kListDue;
}

// Initial pressure: the hydrostatic equilibrium of the start, solved in a step of its own: see
// docs/notes/initial-pressure.md.
void iteratePressure(inout FluidControl c) {
  c.warmStep = c.nextStep;
  if (c.phaseLeft > 1u) {
    c.phaseLeft -= 1u;
  } else {
    setNextPhase(c, kPhaseAdvancing, 0u);
    c.nextStep = fittedStep(c.timeLeft, c.desiredStep);
  }
  setGains(c);
}

void main() {
  FluidControl c = control;
  FluidSums s = sums;
  bool first = push.iteration == 0u;
  if ((first ? c.running : c.again) == 0u) {
    if (first) switchCommands(c, kNoSubstep, s);  // the last correction's command was still on
    return;
  }

  float error = (float(s.errorHigh) * 4294967296.0 + float(s.errorLow)) * kErrorUnit / float(max(c.count, 1u));
  bool converged = params.tolerance > 0.0 && error <= params.tolerance && uintBitsToFloat(s.errorMax) <= 100.0 * params.tolerance;
  bool again = push.iteration + 1u < params.iterations && !converged;
  c.iterations += 1u;
  c.executedIterations += 1u;
  if (first) c.executedSubsteps += 1u;
  sums.errorLow = 0u;
  sums.errorHigh = 0u;
  sums.errorMax = 0u;

  if (first) c.phase = c.nextPhase;
  if (first && c.phase != kPhaseAdvancing) {
    again = false;
    c.step = 0.0;
    c.noiseDamping = 0.0;
    c.artificialPressure = 0.0;
    if (c.phase == kPhaseSettling) settle(c, error, uintBitsToFloat(s.errorMax));
    else iteratePressure(c);
  } else if (first) {
    c.step = c.nextStep;
    c.error = error;
    c.speed = max(uintBitsToFloat(s.speedMax), 0.0);
    sums.speedMax = 0u;
    setGains(c);
    planBlock(c, push.blockStart != 0u);
    c.warmStep = c.step;
    c.timeLeft -= c.step;
    c.substeps += 1u;
    addTime(c, c.step);
    c.travel += (c.speed + c.solidSpeed) * c.step;
    gravityAt(c);
    float acceleration = length(vec3(c.gravityX, c.gravityY, c.gravityZ));
    c.desiredStep = plannedStep(c, tolerableStep(c, error), cflStep(c.speed, acceleration, c.head));
    if (c.timeLeft < 1.0e-4 * c.step) c.timeLeft = 0.0;
    if (c.timeLeft > 0.0 && c.substeps >= params.maxSubsteps) {
      c.timeDropped += c.timeLeft;
      c.timeLeft = 0.0;
    }
    c.nextStep = c.timeLeft > 0.0 ? fittedStep(c.timeLeft, c.desiredStep) : c.desiredStep;
    if (c.travel + (c.speed + c.solidSpeed + acceleration * c.nextStep) * c.nextStep > params.travelLimit) c.listState = kListDue;
  }

  if (first && c.noiseDamping > 0.0) c.executedNoiseDampings += 1u;
  c.running = c.timeLeft > 0.0 && c.listState == kListValid ? 1u : 0u;
  c.again = again ? 1u : 0u;
  switchCommands(c, push.parity, s);
  control = c;
}
