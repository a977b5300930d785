#version 460
// After a list build: enables the substeps of the block.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
layout(local_size_x = 1) in;
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; };
layout(std430, binding = 2) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
#include "fluid/stability.glsl"
#include "fluid/dispatch_commands.glsl"

void main() {
  FluidControl c = control;
  if (c.listState == kListValid || (c.listState == kListDue && c.timeLeft <= 0.0)) return;
  // without an advance a list of the start state, for figures alone: the first advance makes one of its predictions
  c.listState = c.timeLeft > 0.0 ? kListValid : kListDue;
  c.travel = 0.0;
  c.builds += 1u;
  c.executedBuilds += 1u;
  c.running = c.timeLeft > 0.0 ? 1u : 0u;
  FluidSums s = sums;
  followColumn(c, columnHead(s));
  control = c;
  switchCommands(c, kNoSubstep, s);  // the sort's own, too: another rebuild may be recorded behind this one
}
