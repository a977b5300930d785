#version 460
// Corrections of the particles near solids, with the tangential scales of neighbors (docs/notes/walls-and-solids.md), and of their warm
// start: a pass of its own, since other particles would pay for the scales as well. Gathers from `work`.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
#include "fluid/artificial_pressure.glsl"
#include "fluid/background_pressure.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/kernel.glsl"
#include "fluid/solid_samples.glsl"
layout(local_size_x = kFluidGroup) in;

layout(push_constant) uniform Push { ChunkPush push; };
READ_NEAR_TANGENTIAL(8)
READ_UINT4(9, nearSolids)
READ_NEAR_DISPLACED(10)
layout(std430, binding = 11) writeonly buffer CorrectionBlock { vec4 nearCorrection[]; };  // m, two of each particle, of a mass of 1
layout(std430, binding = 12) readonly buffer VelocityBlock { vec4 velocity[]; };
READ_FLOAT(13, coherence)

vec3 here;
vec2 own;  // multiplier change, warm start; in the unit
float inverseMass;
vec3 correction = vec3(0.0), warmDisplacement = vec3(0.0);  // m, once scaled
vec3 gradients = vec3(0.0);                                  // 1/m, once scaled
vec3 excess = vec3(0.0), warmExcess = vec3(0.0);            // of these, what the scales of neighbors add

float unit = params.inverseRestGradient / kMultiplierScale;  // m^2, of the multipliers
// Iterations before the last have none.
float pressure = push.iteration == 0u ? control.artificialPressure * kMultiplierScale : 0.0;

#define COMPANION(j) nearTangentialAt(j)
void visit(uvec4 particle, vec4 tangential) {
  vec3 r = here - uintBitsToFloat(particle.xyz);
  float distance = sqrt(dot(r, r));
  vec3 gradient = gradientShape(distance) * r, more = scaledExcess(unpackSolidScale(tangential), gradient);
  vec2 both = own + unpackHalf2x16(particle.w);
  if (ARTIFICIAL_PRESSURE) both.x -= artificialPressure(distance) * pressure / max(inverseMass, inverseMassOf(fluidOfWork(particle)));
  correction += both.x * gradient;
  gradients += gradient;
  excess += both.x * more;
  if (!WARM) return;
  warmDisplacement += both.y * gradient;
  warmExcess += both.y * more;
}
void reflectSums(vec3 signs) {
  correction *= signs;
  gradients *= signs;
  warmDisplacement *= signs;
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
  uint head = headOf(i, inRange);
  visitNeighbors(i, head, inRange ? i - push.first : 0u, inRange);
  if (!inRange) return;
  float toMeters = unit * params.gradientScale;
  correction *= toMeters;
  warmDisplacement *= toMeters;
  SolidScale scale = solidScaleAt(i, head);
  vec3 displaced = displacedAt(i, head).xyz;
  vec3 bySolids = scale.diagonal != vec3(1.0) ? displaced : vec3(0.0);  // beside mouths alone the fluid goes on
  float flow = coherenceAt(coherencePlace(i));
  vec3 ownGradient = unit * (displaced - backgroundGradient(params.gradientScale * gradients + displaced, bySolids, velocity[i].xyz, flow));
  correction += scaledExcess(scale, correction) + toMeters * excess + own.x * ownGradient;
  warmDisplacement += scaledExcess(scale, warmDisplacement) + toMeters * warmExcess + own.y * ownGradient;
  nearCorrection[2u * i] = vec4(correction, 0.0);
  nearCorrection[2u * i + 1u] = vec4(warmDisplacement, 0.0);
}
