#version 460
// One more Jacobi iteration: moves the prediction by the last multipliers. Gathers from `work`.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
#include "fluid/background_pressure.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/kernel.glsl"
#include "fluid/solid_samples.glsl"
layout(local_size_x = kFluidGroup) in;

layout(push_constant) uniform Push { ChunkPush push; };
layout(std430, binding = 8) buffer PredictionBlock { vec4 prediction[]; };
READ_NEAR_DISPLACED(9)
READ_FLOAT4(10, nearCorrection)  // of pairs.comp
layout(std430, binding = 11) writeonly buffer NearMultipliersBlock { vec2 nearMultipliers[]; };  // as in correct.comp
layout(std430, binding = 12) readonly buffer VelocityBlock { vec4 velocity[]; };
READ_FLOAT(13, coherence)

vec3 here;
float own;
vec3 moved = vec3(0.0);      // m, once scaled
vec3 gradients = vec3(0.0);  // 1/m, once scaled

float unit = params.inverseRestGradient / kMultiplierScale;  // m^2, of the multipliers

void visit(uvec4 particle) {
  vec3 r = here - uintBitsToFloat(particle.xyz);
  vec3 gradient = gradientShape(sqrt(dot(r, r))) * r;
  moved += (own + unpackHalf2x16(particle.w).x) * gradient;
  gradients += gradient;
}
void reflectSums(vec3 signs) {
  moved *= signs;
  gradients *= signs;
}
#define IMAGES
#include "fluid/neighbors.glsl"

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < min(push.last, control.solved);
  if (!inRange) i = params.capacity;
  uvec4 particle = particleAt(i);
  here = uintBitsToFloat(particle.xyz);
  own = unpackHalf2x16(particle.w).x;
  uint head = headOf(i, inRange);
  bool moves = inRange && !sleeps(head);
  bool nearSolids = isNearSolids(head), visits = moves && !nearSolids;
  visitNeighbors(i, visits ? head : 0u, local, visits);
  if (!moves) return;
  vec3 displaced = MOUTHS ? displacedAt(i, head).xyz : vec3(0.0);
  float flow = coherenceAt(coherencePlace(i));
  vec3 ownGradient = displaced - backgroundGradient(params.gradientScale * gradients + displaced, vec3(0.0), velocity[i].xyz, flow);
  moved = unit * (params.gradientScale * moved + own * ownGradient);
  if (nearSolids) {
    moved = nearCorrectionAt(2u * i).xyz;
    if (LOADS) nearMultipliers[i] = vec2(unit * own, 0.0);
  }
  prediction[i] = vec4(insideWalls(here + inverseMassOf(fluidOfWork(particle)) * moved), prediction[i].w);
}
