#version 460
// The prediction x* = x + dt (v + dt (g + a)), a the warm start's acceleration; w: m that solids pushed it
// out. Runs where the correction could not make it: for an advance's first substep, whose step was not
// known, and after forces that changed velocities. NEAR_SOLIDS: for the particles that solids may push alone.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "shared/arrays.glsl"
READ_FLOAT4(2, position)
READ_FLOAT4(3, velocity)
READ_FLOAT4(4, warmAcceleration)
layout(std430, binding = 5) writeonly buffer PredictionBlock { vec4 prediction[]; };
READ_UINT4(6, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
READ_UINT4(7, nearSolids)
layout(std430, binding = 8) readonly buffer SumsBlock { FluidSums sums; };
READ_UINT(9, meshWord)
READ_UINT(10, listHead)
#include "fluid/sleeping.glsl"
#include "fluid/outside.glsl"
layout(local_size_x = kFluidGroup) in;

void main() {
  uint i = flatInvocation();
  if (i >= (NEAR_SOLIDS ? sums.nearSolids : control.solved)) return;
  NearSolids near = nearSolidsOf(NEAR_SOLIDS ? i : 0u);
  if (NEAR_SOLIDS) i = near.particle;
  if (isAsleep(i)) return;
  vec4 present = positionAt(i);
  vec3 x = present.xyz;
  vec3 next = predicted(x, velocityAt(i).xyz, keptWarmAcceleration(warmAccelerationAt(i)));
  float pushed = 0.0;
  next = NEAR_SOLIDS ? outside(next, near, ahead(), false, pushed) : insideWalls(next);
  prediction[i] = vec4(isFinite(next) ? next : x, withFluid(pushed, fluidOfPosition(present)));
}
