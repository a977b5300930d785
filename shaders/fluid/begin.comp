#version 460
// Begins an advance: its length, the first step, and the commands of its first block.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
#include "fluid/control_copy.glsl"
layout(push_constant) uniform Push { BeginPush push; };
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 2) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) readonly buffer GravityBlock { vec4 gravityChanges[]; };
#ifdef MERGED
layout(std430, binding = 6) writeonly buffer DensityCommandBlock { uint densityCommands[]; };
#endif
#include "fluid/gains.glsl"
#include "fluid/step_plan.glsl"
#include "fluid/dispatch_commands.glsl"
#ifdef MERGED
#include "fluid/density_commands.glsl"
#endif
#include "fluid/sleep.glsl"

void main() {
  control = stored.control;
  if (push.queued != 0u && control.timeLeft > 0.0) {
    switchCommands(kNoBegin);
    return;
  }
  control.timeDropped = max(control.timeLeft, 0.0);  // an advance that was not recorded to its end
  control.timeLeft = push.advance;
  control.substeps = 0u;
  control.iterations = 0u;
  control.builds = 0u;
  control.solidSpeed = max(params.solidSpeed, push.drivenSpeed);
  control.pulls = push.pulls;
  sleepThrough(push.drives > 0u || push.pulls > 0u);
  gravityAt();
  float acceleration = length(vec3(control.gravityX, control.gravityY, control.gravityZ));
  control.speed = uintBitsToFloat(sums.speedMax);
  // fluid beside an open mouth is in motion, but the initial pressure is that of fluid at rest
  if (control.nextPhase == kPhaseAdvancing) control.speed = max(control.speed, control.emitterSpeed);
  control.bodySpeed = uintBitsToFloat(sums.bodySpeed);
  if (control.nextRelaxation == 0.0) setGains();  // the first advance: from then on each substep sets those of the next
  control.desiredStep = plannedStep(control.desiredStep, cflStep(acceleration, control.head));
  bool going = control.timeLeft > 0.0;
  if (going) {
    control.nextStep = fittedStep(control.timeLeft, control.desiredStep);
    // the last advance was cut short; once a solid moves, the initial pressure no longer fits
    if (push.drivenSpeed > 0.0 && control.nextPhase == kPhaseInitialPressure) setNextPhase(kPhaseAdvancing, 0u);
    if (control.nextPhase == kPhaseInitialPressure) control.nextStep = params.initialPressureStep;
    if (control.warmStep <= 0.0) control.warmStep = control.nextStep;
    float fastest = max(control.speed, control.emitterSpeed) + max(control.solidSpeed, control.bodySpeed);
    float nextTravel = control.travel + (fastest + acceleration * control.nextStep) * control.nextStep;
    if (control.nextPhase != kPhaseInitialPressure && nextTravel > travelLimit() && control.listState == kListValid)
      control.listState = kListDue;
    bool due = control.emissionWait <= 0.0 || regionsAreDue();
    if (due && control.listState == kListValid) control.listState = kListDue;
  }
  if (push.mouths != 0u && control.listState == kListValid) control.listState = kListDue;
  control.running = going && control.listState == kListValid ? 1u : 0u;
  control.again = 0u;
  switchCommands(kNoSubstep);
#ifdef MERGED
  setDensityCommands();
#endif
  storeControl();
}
