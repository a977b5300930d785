// The two uniform blocks of every fluid pass, at bindings 0 and 1. MERGED: the pass may write the control block.
#ifndef RILL_UNIFORMS_GLSL
#define RILL_UNIFORMS_GLSL
#include "shared/fluid_records.h"
#include "shared/active.glsl"
#include "shared/dispatch.glsl"
#include "fluid/constants.glsl"
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
#ifdef MERGED
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; };
#else
layout(binding = 1) uniform ControlBlock { FluidControl control; };
#endif

vec3 wallsLow() { return vec3(params.lowX, params.lowY, params.lowZ); }
vec3 wallsHigh() { return vec3(params.highX, params.highY, params.highZ); }

// Whether x is above the level of the outflow, whose side is no wall there.
bool aboveOutflow(vec3 x) { return OUTFLOW && x.y > params.outflowLevel; }

// The first group of the list of the particle at `local` in its chunk: see shared/neighbor_list.h.
uint firstGroup(uint local) { return (local / kListBlock) * (kListBlock * (LIST_CAPACITY / 4u)) + local % kListBlock; }

// Keeps a center half a spacing off the domain's walls. NaN and inactive particles are returned unchanged.
vec3 insideWalls(vec3 x) {
  if (!isActive(x) || !isWithin(x, 3.0e38)) return x;
  vec3 low = wallsLow() + params.margin, high = wallsHigh() - params.margin;
  if (aboveOutflow(x)) {
    if (params.outflowSide % 2u == 0u) low[params.outflowSide / 2u] = -kNoWall;
    else high[params.outflowSide / 2u] = kNoWall;
  }
  return vec3(x.x < low.x ? low.x : (x.x > high.x ? high.x : x.x),
              x.y < low.y ? low.y : (x.y > high.y ? high.y : x.y),
              x.z < low.z ? low.z : (x.z > high.z ? high.z : x.z));
}

// The warm-start acceleration, m/s^2; without a warm start nothing writes its array.
vec3 keptWarmAcceleration(vec4 stored) { return WARM ? stored.xyz : vec3(0.0); }

bool isFinite(vec3 x) { return isWithin(x, params.farLimit); }

vec3 gravity() { return vec3(control.gravityX, control.gravityY, control.gravityZ); }

// The prediction of the next substep, before walls and solids; `away`: acceleration of the warm start, m/s^2.
vec3 predicted(vec3 x, vec3 v, vec3 away) {
  if (control.nextPhase == kPhaseSettling) return x;
  if (control.nextPhase == kPhaseInitialPressure) v = vec3(0.0);  // the initial pressure balances weight, not motion
  return x + control.nextStep * (v + control.nextStep * (gravity() + away));
}

// Seconds from now to the predicted instant, for the pose of solids, which do not move before the
// first substep in time.
float ahead() { return control.nextPhase == kPhaseAdvancing ? control.nextStep : 0.0; }
#endif
