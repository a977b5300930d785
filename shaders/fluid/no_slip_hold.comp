#version 460
// How solids hold the particles near them that stick to one, for the solve of viscosity; bodies follow in no_slip.comp.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
READ_UINT(7, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
layout(local_size_x = kFluidGroup) in;

READ_UINT4(2, work)
READ_UINT4(3, nearSolids)
layout(std430, binding = 4) readonly buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(5, table)
READ_UINT4(6, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
layout(std430, binding = 8) writeonly buffer HoldBlock { vec4 hold[]; };
READ_FLOAT4(9, priorVelocity)
READ_UINT(10, listHead)
#include "fluid/no_slip.glsl"
#include "fluid/sleeping.glsl"

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids) return;
  NearSolids near = nearSolidsOf(n);
  if (isAsleep(near.particle)) return;
  uvec4 particle = workAt(near.particle);
  vec3 x = uintBitsToFloat(particle.xyz);
  Adhesion a = Adhesion(0.0, vec3(0.0));
  if (isActive(x)) a = adhesionAt(near, x, mobility(near.particle, fluidOfWork(particle)), false);
  hold[near.particle] = vec4(a.pull, a.all);
}
