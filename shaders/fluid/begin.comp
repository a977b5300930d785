#version 460
// Begins an advance: its length, the first step, and the commands of its first block.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
layout(local_size_x = 1) in;
layout(push_constant) uniform Push { BeginPush push; };
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; };
layout(std430, binding = 2) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) readonly buffer GravityBlock { vec4 gravityChanges[]; };
#include "fluid/gains.glsl"
#include "fluid/step_plan.glsl"
#include "fluid/dispatch_commands.glsl"
#include "fluid/time.glsl"

void main() {
  FluidControl c = control;
  FluidSums s = sums;
  c.timeDropped = max(c.timeLeft, 0.0);  // an advance that was not recorded to its end
  c.timeLeft = push.advance;
  c.substeps = 0u;
  c.iterations = 0u;
  c.builds = 0u;
  c.solidSpeed = max(params.solidSpeed, push.drivenSpeed);
  gravityAt(c);
  float acceleration = length(vec3(c.gravityX, c.gravityY, c.gravityZ));
  c.speed = uintBitsToFloat(s.speedMax);
  if (c.nextRelaxation == 0.0) setGains(c);  // the first advance: from then on each substep sets those of the next
  c.desiredStep = plannedStep(c, c.desiredStep, cflStep(c.speed, acceleration, c.head));
  bool going = push.advance > 0.0;
  if (going) {
    c.nextStep = fittedStep(push.advance, c.desiredStep);
    // the last advance was cut short; once a solid moves, the initial pressure no longer fits
    if (push.drivenSpeed > 0.0 && c.nextPhase == kPhaseInitialPressure) setNextPhase(c, kPhaseAdvancing, 0u);
    if (c.nextPhase == kPhaseInitialPressure) c.nextStep = params.initialPressureStep;
    if (c.warmStep <= 0.0) c.warmStep = c.nextStep;
    float nextTravel = c.travel + (c.speed + c.solidSpeed + acceleration * c.nextStep) * c.nextStep;
    if (c.nextPhase != kPhaseInitialPressure && nextTravel > params.travelLimit && c.listState == kListValid) c.listState = kListDue;
  }
  c.running = going && c.listState == kListValid ? 1u : 0u;
  c.again = 0u;
  switchCommands(c, kNoSubstep, s);
  control = c;
}
