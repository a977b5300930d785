#version 460
// Fluid sticks to bodies: after the solve of viscosity, an implicit step toward their velocity. LOADS: the reaction on all solids.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
READ_UINT(7, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
layout(local_size_x = kFluidGroup) in;

READ_UINT4(2, work)        // the prediction of the substep
READ_UINT4(3, nearSolids)
layout(std430, binding = 4) readonly buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(5, table)
READ_UINT4(6, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
layout(std430, binding = 8) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 9) buffer SolidSumsBlock { uint solidSums[]; };
READ_FLOAT4(10, priorVelocity)
READ_UINT(11, listHead)
#include "fluid/no_slip.glsl"
#include "fluid/sleeping.glsl"
#include "fluid/solid_reaction.glsl"

void addReactions(NearSolids near, vec3 x, vec3 v, uint fluid, float mobile) {
  Images images = imagesNear(x, params.support);
  bool more = true;
  LOOP_WHILE (more) {
    vec3 signs, image = imageOf(nextImage(images), x, signs);
    for (uint m = 0u, k; nextSolid(near, m, k); ++m) {
      SolidRecord s = solidAt(k);
      vec3 toward = velocityAt(s.pose, image) - imageVelocity(signs, v);
      addToSolid(k, centerOf(s.pose), control.step / inverseMassOf(fluid) * adhesion(s, image, mobile) * toward, image);
    }
    more = advance(images);
  } LOOP_END(more);
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids) return;
  NearSolids near = nearSolidsOf(n);
  if (isAsleep(near.particle)) return;
  uvec4 particle = workAt(near.particle);
  uint fluid = fluidOfWork(particle);
  float mobile = mobility(near.particle, fluid);
  vec3 x = uintBitsToFloat(particle.xyz);
  if (!isActive(x)) return;
  vec3 v = velocity[near.particle].xyz;
  if (BODIES) {
    Adhesion a = adhesionAt(near, x, mobile, true);
    if (a.all > 0.0) velocity[near.particle].xyz = v = (v + a.pull) / (1.0 + a.all);
  }
  if (LOADS) addReactions(near, x, v, fluid, mobile);
}
