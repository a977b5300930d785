#version 460
// Sums of the particles that stick to each body, from which no_slip_bodies.comp finds the velocity that it will have.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
READ_UINT(7, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
#include "shared/body_records.h"
layout(local_size_x = kFluidGroup) in;

READ_UINT4(2, work)
READ_UINT4(3, nearSolids)
layout(std430, binding = 4) readonly buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(5, table)
READ_UINT4(6, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
layout(std430, binding = 8) readonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 9) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 10) readonly buffer BodyBlock { BodyRecord bodies[]; };
READ_FLOAT4(11, priorVelocity)
READ_UINT(12, listHead)
#include "fluid/no_slip.glsl"
#include "fluid/sleeping.glsl"
#include "fluid/solid_sums.glsl"

// `b`: what the particle gives a body of its velocity w relative to it, over the mass of one of the densest fluid.
void addToBody(uint body, float b, vec3 x, vec3 w) {
  vec3 r = (x - centerOf(bodies[body].state)) / params.loadLever, moved = w * (control.step / params.spacing), turn = cross(r, moved);
  float values[kNoSlipComponents] = float[](1.0, r.x, r.y, r.z, r.x * r.x, r.y * r.y, r.z * r.z, r.y * r.z, r.z * r.x, r.x * r.y, moved.x,
                                            moved.y, moved.z, turn.x, turn.y, turn.z);
  for (uint c = 0u; c < kNoSlipComponents; ++c) {
    int high;
    uint low;
    split(b * values[c] / kDisplacementUnits, high, low);
    addWide(params.solidCount * kSolidSumWords + body * kNoSlipSumWords + 2u * c, high, low);
  }
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids) return;
  NearSolids near = nearSolidsOf(n);
  if (isAsleep(near.particle)) return;
  uvec4 particle = workAt(near.particle);
  uint fluid = fluidOfWork(particle);
  float mobile = mobility(near.particle, fluid);
  vec3 x = uintBitsToFloat(particle.xyz), v = velocity[near.particle].xyz;
  if (!isActive(x)) return;
  Adhesion all = adhesionAt(near, x, mobile, true);
  if (!(all.all > 0.0)) return;
  Images images = imagesNear(x, params.support);
  bool more = true;
  LOOP_WHILE (more) {
    vec3 signs, image = imageOf(nextImage(images), x, signs);
    for (uint m = 0u, k; nextSolid(near, m, k); ++m) {
      SolidRecord s = solidAt(k);
      if (s.body == kNoBody || bodies[s.body].held != 0u || bodies[s.body].stopped != 0u) continue;
      float a = adhesion(s, image, mobile), others = 1.0 + all.all - a;
      if (!(a > 0.0)) continue;
      vec3 own = velocityAt(s.pose, image), free = (v + all.pull - a * imageVelocity(signs, own)) / others;
      addToBody(s.body, a * others / (others + a) / inverseMassOf(fluid), image, imageVelocity(signs, free) - own);
    }
    more = advance(images);
  } LOOP_END(more);
}
