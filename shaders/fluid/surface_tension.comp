#version 460
// Surface tension, second pass: the force of a particle's own samples, and that of the samples of others around it, which is what these
// feel, reversed. See engine/sph/surface_tension.hpp.
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/surface_samples.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_UINT2(8, surfaceSample)
READ_FLOAT(9, exposed)
layout(std430, binding = 10) buffer VelocityBlock { vec4 velocity[]; };

// The tension of a particle with exposed samples, else 0, and its index in two parts, each exact in a float.
const uint kIndexPart = 4096u;
#define COMPANION(j) vec4(exposedAt(j), float((j) / kIndexPart), float((j) % kIndexPart), 0.0)

Samples samplesOf(uint i) {
  Samples s;
  EACH_PART(k) {
    uvec2 stored = surfaceSampleAt(i * kSampleParts + k);
    s.part[k] = vec4(unpackHalf2x16(stored.x), unpackHalf2x16(stored.y));
  }
  return s;
}

vec3 here;
uvec4 coverOfFluids;
float ownTension;
Samples own = ofAll(0.0);
vec3 force = vec3(0.0);

// What samples around one particle do to another at `apart` from it, over params.tensionRate; the first one feels the opposite.
vec3 pull(Samples samples, vec3 apart) {
  Samples near = nearness(apart);
  EACH_PART(k) near.part[k] *= near.part[k] * samples.part[k];
  return kTensionRadius * params.spacing * resultant(near) - total(near) * apart;
}

void visit(vec4 particle, vec4 companion) {
  vec3 apart = particle.xyz - here;
  float cover = INTERFACES ? coverBy(coverOfFluids, fluidOfPosition(particle)) : 1.0;
  if (ownTension > 0.0) force -= cover * ownTension * pull(own, apart);
  if (companion.x > 0.0) force += cover * companion.x * pull(samplesOf(uint(companion.y) * kIndexPart + uint(companion.z)), -apart);
}
#include "fluid/neighbors.glsl"

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < min(push.last, control.solved);
  if (!inRange) i = params.capacity;
  vec4 particle = particleAt(i);
  here = particle.xyz;
  uint head = headOf(i, inRange);
  bool moves = inRange && isActive(here) && !sleeps(head);
  ownTension = moves ? exposedAt(i) : 0.0;
  if (ownTension > 0.0) own = samplesOf(i);
  if (INTERFACES) coverOfFluids = coverRow(fluidOfPosition(particle));
  visitNeighbors(i, moves ? head : 0u, local, moves);
  if (moves) velocity[i].xyz += control.step * params.tensionRate * inverseMassOf(fluidOfPosition(particle)) * force;
}
