#version 460
// Surface tension at solids: the plane of the nearest solid's surface, for the samples around each particle near solids.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
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
layout(std430, binding = 6) writeonly buffer PlaneBlock { vec4 solidPlane[]; };  // xyz: away from the solid, w: distance in m

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids) return;
  NearSolids near = nearSolidsOf(n);
  if (near.particle >= control.solved) return;
  solidPlane[near.particle] = surfaceSolidAt(near, positionAt(near.particle).xyz).plane;
}
