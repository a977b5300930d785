#version 460
// Begins an advance: its length, the first step, and the commands of its first block.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { BeginPush push; };
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; };
layout(std430, binding = 2) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) readonly buffer GravityBlock { vec4 gravityChanges[]; };
#include "fluid/step_plan.glsl"
#include "fluid/switches.glsl"

void main() {
  FluidControl c = control;
  FluidSums s = sums;
  barrier();
  uint k = gl_LocalInvocationID.x;
  c.timeDropped = max(c.timeLeft, 0.0);  // an advance that was not recorded to its end
  c.timeLeft = push.advance;
  c.substeps = 0u;
  c.iterations = 0u;
  c.builds = 0u;
  gravityAt(c);
  float acceleration = length(vec3(c.gravityX, c.gravityY, c.gravityZ));
  c.speed = uintBitsToFloat(s.speedMax);
  float bound = desiredStep(0.0, c.speed, 0.0, acceleration);
  c.desiredStep = c.desiredStep > 0.0 ? min(c.desiredStep, bound) : bound;
  bool going = push.advance > 0.0;
  if (going) {
    c.step = fittedStep(push.advance, c.desiredStep, params.maxSubsteps);
    if (c.warmStep <= 0.0) c.warmStep = c.step;
    if (c.travel + (c.speed + params.solidSpeed + acceleration * c.step) * c.step > params.travelLimit) c.stale = max(c.stale, 1u);
  }
  if (k < push.commands) {
    bool on;
    if (k == kCommandPredict) on = going;
    else if (k == kCommandDensity || k == kCommandControl || k == kCommandPlane || k == kCommandCorner) on = going && c.stale == 0u;
    else if (k == kCommandMeasurePlane || k == kCommandMeasureCorner) on = true;
    else if (k == kCommandKeys || k == kCommandReorder || k == kCommandBuild || k == kCommandArm || k >= kCommandSort)
      on = c.stale == 2u || (going && c.stale != 0u);
    else on = false;
    switchCommand(k, on, s);
  }
  if (k == 0u) control = c;
}
