#version 460
// After a density pass, where it does not do it itself: see control.glsl. And enables the dispatch commands that follow.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
#include "fluid/control_copy.glsl"
layout(push_constant) uniform Push { ControlPush push; };
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 2) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) readonly buffer GravityBlock { vec4 gravityChanges[]; };
#include "fluid/control.glsl"
#include "fluid/dispatch_commands.glsl"

void main() {
  control = stored.control;
  uint parity = accountSubstep(push.iteration, push.parity, push.blockStart != 0u);
  if (parity == kKeepCommands) return;
  switchCommands(parity);
  storeControl();
}
