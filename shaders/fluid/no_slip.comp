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
READ_UINT4(3, nearSolids)  // NearSolidRecord
layout(std430, binding = 4) readonly buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(5, table)
layout(std430, binding = 6) readonly buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 8) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 9) buffer SolidSumsBlock { uint solidSums[]; };
READ_FLOAT4(10, priorVelocity)
#include "fluid/no_slip.glsl"
#include "fluid/solid_sums.glsl"

void addReactions(uvec3 near, vec3 x, vec3 v, uint fluid, float mobile) {
  Images images = imagesNear(x, params.support);
  bool more = true;
  LOOP_WHILE (more) {
    vec3 signs, image = imageOf(nextImage(images), x, signs);
    for (uint m = 0u, k; nextSolid(near, m, k); ++m) {
      vec3 toward = velocityAt(solids[k].pose, image) - imageVelocity(signs, v);
      addToSolid(k, control.step / inverseMassOf(fluid) * adhesion(k, image, mobile) * toward, image);
    }
    more = advance(images);
  } LOOP_END(more);
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids) return;
  uvec4 near = nearSolidsAt(n);
  uvec4 particle = workAt(near.x);
  uint fluid = fluidOfWork(particle);
  float mobile = mobility(near.x, fluid);
  vec3 x = uintBitsToFloat(particle.xyz);
  if (!isActive(x)) return;
  vec3 v = velocity[near.x].xyz;
  if (BODIES) {
    Adhesion a = adhesionAt(near.yzw, x, mobile, true);
    if (a.all > 0.0) velocity[near.x].xyz = v = (v + a.pull) / (1.0 + a.all);
  }
  if (LOADS) addReactions(near.yzw, x, v, fluid, mobile);
}
