#version 460
// The forces of surface tension change velocities, and the list of particles near surfaces is empty again.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "shared/arrays.glsl"
#include "shared/surface_tension.h"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, position)
READ_UINT(3, listHead)
#include "fluid/sleeping.glsl"
layout(std430, binding = 4) readonly buffer ForceBlock { int surfaceForce[]; };
layout(std430, binding = 5) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 6) writeonly buffer SurfaceParticleBlock { uint surfaceParticle[]; };

void main() {
  uint i = flatInvocation();
  if (i < kMaxSurfaceChunks) surfaceParticle[params.capacity + i] = 0u;
  if (i >= control.solved) return;
  vec4 particle = positionAt(i);
  bool asleep = isAsleep(i);
  if (!isActive(particle.xyz) || asleep) return;
  vec3 force = vec3(surfaceForce[3u * i], surfaceForce[3u * i + 1u], surfaceForce[3u * i + 2u]);
  float scale = control.step * params.tensionRate * inverseMassOf(fluidOfPosition(particle)) * params.spacing / kTensionUnits;
  velocity[i].xyz += scale * force;
}
