#version 460
// What the tangential scales of neighbors add to the corrections of the particles near solids (docs/notes/walls-and-solids.md): of the
// correction, and of the warm start. Gathers from `work`.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
#include "fluid/artificial_pressure.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/kernel.glsl"
#include "fluid/solid_samples.glsl"
layout(local_size_x = kFluidGroup) in;

layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, nearTangential)
READ_UINT4(9, nearSolids)
layout(std430, binding = 10) writeonly buffer ExcessBlock { vec4 nearExcess[]; };  // m, two of each particle, of a mass of 1

vec3 here;
vec2 own;  // multiplier change, warm start; in the unit
float inverseMass;
vec3 excess = vec3(0.0), warmExcess = vec3(0.0);

float unit = params.inverseRestGradient / kMultiplierScale;  // m^2, of the multipliers
// Iterations before the last have none.
float pressure = push.iteration == 0u ? control.artificialPressure * kMultiplierScale : 0.0;

#define COMPANION(j) nearTangentialAt(j)
void visit(uvec4 particle, vec4 tangential) {
  vec3 r = here - uintBitsToFloat(particle.xyz);
  float distance = sqrt(dot(r, r));
  vec3 gradient = scaledExcess(unpackSolidScale(tangential), gradientShape(distance) * r);
  vec2 both = own + unpackHalf2x16(particle.w);
  if (ARTIFICIAL_PRESSURE) both.x -= artificialPressure(distance) * pressure / max(inverseMass, inverseMassOf(fluidOfWork(particle)));
  excess += both.x * gradient;
  warmExcess += both.y * gradient;
}
void reflectSums(vec3 signs) {
  excess *= signs;
  warmExcess *= signs;
}
#define IMAGES
#include "fluid/neighbors.glsl"

void main() {
  uint n = clusterInvocation();
  uint i = nearSolidsAt(NEAR_QUADS * min(n, max(sums.nearSolids, 1u) - 1u)).x;
  bool inRange = n < sums.nearSolids && i >= push.first && i < min(push.last, control.solved);
  inRange = inRange && (!sleeps(headOf(i, inRange)) || gathersAsleep());
  if (!inRange) i = params.capacity;
  uvec4 particle = particleAt(i);
  here = uintBitsToFloat(particle.xyz);
  own = unpackHalf2x16(particle.w);
  inverseMass = inverseMassOf(fluidOfWork(particle));
  visitNeighbors(i, headOf(i, inRange), inRange ? i - push.first : 0u, inRange);
  if (!inRange) return;
  float toMeters = unit * params.gradientScale;
  nearExcess[2u * i] = vec4(toMeters * excess, 0.0);
  nearExcess[2u * i + 1u] = vec4(toMeters * warmExcess, 0.0);
}
