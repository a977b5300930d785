// The two uniform blocks of every fluid pass, at bindings 0 and 1.
#ifndef RILL_UNIFORMS_GLSL
#define RILL_UNIFORMS_GLSL
#include "shared/fluid_records.h"
#include "shared/dispatch.glsl"
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(binding = 1) uniform ControlBlock { FluidControl control; };

// Keeps a center half a spacing off the domain's walls. NaN goes through, and so does a parked particle.
vec3 insideWalls(vec3 x) {
  if (x.x == kParked) return x;
  vec3 low = vec3(params.lowX, params.lowY, params.lowZ) + params.margin;
  vec3 high = vec3(params.highX, params.highY, params.highZ) - params.margin;
  return vec3(x.x < low.x ? low.x : (x.x > high.x ? high.x : x.x),
              x.y < low.y ? low.y : (x.y > high.y ? high.y : x.y),
              x.z < low.z ? low.z : (x.z > high.z ? high.z : x.z));
}

bool isFinite(vec3 x) {
  vec3 limit = vec3(params.farLimit);
  return all(lessThan(abs(x), limit));  // false for NaN, too
}

vec3 gravity() { return vec3(control.gravityX, control.gravityY, control.gravityZ); }

// The prediction of the next substep, before walls and solids; `away`: the warm start's push, m/s^2.
vec3 predicted(vec3 x, vec3 v, vec3 away) {
  if (control.settling != 0u) return x;
  if (control.pressing != 0u) v = vec3(0.0);  // the start's pressure bears weight, it does not stop what moves
  return x + control.nextStep * (v + control.nextStep * (gravity() + away));
}

// Seconds until then, for solids: while the start is prepared they stand still.
float ahead() { return control.settling != 0u || control.pressing != 0u ? 0.0 : control.nextStep; }
#endif
