#version 460
// Ends a substep's density pass: accounts for its step, plans the next ones, and switches the dispatch commands that follow.
// Everything that depends on the simulation's state is decided here, on the device, so that no bit depends on when the host reads.
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
#include "fluid/calmness.glsl"
#include "fluid/step_plan.glsl"
#include "fluid/switches.glsl"

void main() {
  FluidControl c = control;
  FluidSums s = sums;
  bool first = push.iteration == 0u;
  if ((first ? c.running : c.again) == 0u) {
    if (first) switchCommands(push.commands, c, 2u, s);  // the last correction's command was still on
    return;
  }

  float error = (float(s.errorHigh) * 4294967296.0 + float(s.errorLow)) * kErrorUnit / float(params.count);
  bool converged = params.tolerance > 0.0 && error <= params.tolerance && uintBitsToFloat(s.errorMax) <= 100.0 * params.tolerance;
  bool again = push.iteration + 1u < params.iterations && !converged;
  c.iterations += 1u;
  c.ranIterations += 1u;
  if (first) c.ranSubsteps += 1u;
  if (first && push.blockStart != 0u) c.ranBlocks += 1u;
  sums.errorLow = 0u;
  sums.errorHigh = 0u;
  sums.errorMax = 0u;

  // Particles that overlap at the start part first: position corrections without a step in time give no speed, where a short step would give them all of it.
  if (first && c.settling > 0u) {
    float enough = params.tolerance > 0.0 ? min(params.tolerance, 0.001) : 0.001;
    // What is left becomes speed in the first step: a small part of what a correction may always add. Rounding leaves 1e-6.
    if (params.pushLow > 0.0) enough = min(enough, max(0.05 * params.pushLow * c.nextStep / params.spacing, 2.0e-6));
    float rest = params.pressings > 0u ? min(0.5 * enough, params.pressError) : 0.5 * enough;  // so that the start's pressure may be looked for
    bool apart = error <= rest && uintBitsToFloat(s.errorMax) <= 20.0 * enough;
    c.settling = apart ? 0u : c.settling - 1u;
    c.step = 0.0;
    c.calming = 0.0;
    c.parting = 0.0;
    setGains(c);
    if (c.settling == 0u && params.pressings > 0u && error <= params.pressError) {
      c.pressing = params.pressings;
      c.nextStep = c.warmStep = params.pressStep;
    }
    c.travel += 0.1 * params.spacing;
    if (c.travel > params.travelLimit) c.stale = 1u;
    again = false;
  } else if (first && c.pressing > 0u) {
    // Then the pressure that bears the start's weight is found, in a step of its own: see ARCHITECTURE.md, "The start's pressure".
    c.pressing -= 1u;
    c.momentum = c.pressing > 0u ? params.pressMomentum : 0.0;
    c.warmStep = c.nextStep;
    c.step = 0.0;
    c.calming = 0.0;
    c.parting = 0.0;
    setGains(c);
    if (c.pressing == 0u) c.nextStep = fittedStep(c.timeLeft, c.desiredStep);
    again = false;
  } else if (first) {
    c.momentum = -1.0;
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
    c.desiredStep = plannedStep(c, tolerableStep(c, error), cflStep(c.speed, acceleration));
    if (c.timeLeft < 1.0e-4 * c.step) c.timeLeft = 0.0;
    if (c.timeLeft > 0.0 && c.substeps >= params.maxSubsteps) {
      c.timeDropped += c.timeLeft;
      c.timeLeft = 0.0;
    }
    c.nextStep = c.timeLeft > 0.0 ? fittedStep(c.timeLeft, c.desiredStep) : c.desiredStep;
    if (c.travel + (c.speed + c.solidSpeed + acceleration * c.nextStep) * c.nextStep > params.travelLimit) c.stale = 1u;
  }

  if (first && c.calming > 0.0) c.ranCalms += 1u;
  c.running = c.timeLeft > 0.0 && c.stale == 0u ? 1u : 0u;
  c.again = again ? 1u : 0u;
  switchCommands(push.commands, c, push.parity, s);
  control = c;
}
