#version 460
// After a list build: the list is fresh, the substeps of the block may run.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
layout(local_size_x = 1) in;
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; };
layout(std430, binding = 2) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) readonly buffer GravityBlock { vec4 gravityChanges[]; };
#include "fluid/switches.glsl"

void main() {
  control.stale = 0u;
  control.travel = 0.0;
  control.builds += 1u;
  FluidSums s = sums;
  bool going = control.timeLeft > 0.0;
  switchCommand(kCommandDensity, going, s);
  switchCommand(kCommandControl, going, s);
  switchCommand(kCommandPlane, going, s);
  switchCommand(kCommandCorner, going, s);
  switchCommand(kCommandMeasurePlane, true, s);
  switchCommand(kCommandMeasureCorner, true, s);
}
