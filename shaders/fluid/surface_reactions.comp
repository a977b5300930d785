#version 460
// The reaction to surface tension on the solid nearest to each particle. It acts at the particle's samples, so that at flat faces the
// torque, too, is the gradient of the energy. By the solids' poses at the end of the substep.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "shared/arrays.glsl"
READ_UINT(7, meshWord)
#define MESH_WORDS
READ_UINT4(3, nearSolids)
#include "fluid/near_solids.glsl"
#include "shared/pose.glsl"
#include "shared/shape.glsl"
layout(local_size_x = kFluidGroup) in;

READ_FLOAT4(2, position)
layout(std430, binding = 4) readonly buffer SumsBlock { FluidSums sums; };
READ_UINT4(5, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
#include "fluid/surface_solid.glsl"
READ_FLOAT4(6, solidPlane)  // as surface_tension.comp leaves it
layout(std430, binding = 8) buffer SolidSumsBlock { uint solidSums[]; };
#include "fluid/solid_reaction.glsl"
READ_UINT(9, listHead)
#include "fluid/sleeping.glsl"

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids || control.phase != kPhaseAdvancing) return;
  NearSolids near = nearSolidsOf(n);
  uint i = near.particle;
  if (i >= control.solved) return;
  vec4 particle = positionAt(i), reaction = solidPlaneAt(i);
  bool asleep = isAsleep(i);
  if (!isActive(particle.xyz) || asleep || !(reaction.w > 0.0)) return;
  SurfaceSolid solid = surfaceSolidAt(near, particle.xyz);
  if (solid.index == kNoSolid) return;
  float scale = control.step * control.step * params.tensionWall * tensionOf(fluidOfPosition(particle));
  addToSolid(solid.index, solid.center, -scale * reaction.w * solid.plane.xyz, particle.xyz + reaction.xyz / reaction.w);
}
