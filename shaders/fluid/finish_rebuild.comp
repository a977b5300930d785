#version 460
// After a list build: enables the substeps of the block.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
#include "fluid/control_copy.glsl"
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 2) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) readonly buffer CellStartBlock { uint cellStart[]; };
#ifdef MERGED
layout(std430, binding = 6) writeonly buffer DensityCommandBlock { uint densityCommands[]; };
#endif
#include "fluid/constants.glsl"
#include "fluid/stability.glsl"
#include "fluid/dispatch_commands.glsl"
#ifdef MERGED
#include "fluid/density_commands.glsl"
#endif

// Bounds only rise: see docs/notes/column-height.md.
void followColumn(float head) {
  if (head > kAddedAtOnce * control.head) {  // water without its pressure, as at a start
    control.desiredStep = min(control.desiredStep, firstStep(head));
    control.errorRate = 0.0;
  }
  control.head = max(control.head, head);
}

void main() {
  control = stored.control;
  if (control.listState == kListValid || (control.listState == kListDue && control.timeLeft <= 0.0)) return;
  // without an advance a list of the start state, for figures alone: the first advance makes one of its predictions
  control.listState = control.timeLeft > 0.0 ? kListValid : kListDue;
  control.travel = 0.0;
  control.builds += 1u;
  control.executedBuilds += 1u;
  control.running = control.timeLeft > 0.0 ? 1u : 0u;
  uint cells = params.gridSizeX * params.gridSizeY * params.gridSizeZ;
  if (REMOVES) control.count = cellStart[(REGIONS ? 2u : 1u) * cells];  // inactive particles come last
  control.solved = REGIONS ? cellStart[cells] : control.count;
  control.sleepStep = control.warmStep;
  control.regionTime = 0.0;
  control.wakesAll = 0u;
  control.regionsDue = 0u;
  FluidSums s = sums;
  followColumn(columnHead(s));
  switchCommands(kNoSubstep);  // the sort's own, too: another rebuild may be recorded behind this one
#ifdef MERGED
  setDensityCommands();
#endif
  storeControl();
}
