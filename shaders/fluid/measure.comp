#version 460
// Density at the positions of the present instant (images and solids included), and histograms of its error for
// the percentiles. Walks a grid of its own, made of the positions: no neighbor that the solver's
// list has missed is missed here.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"
#include "fluid/density_scale.glsl"
#include "fluid/images.glsl"
#include "fluid/solid_samples.glsl"
#include "shared/loops.glsl"
#include "shared/number.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, orderedPosition)  // w: the particle's place in the solver's arrays
READ_UINT(3, cellStart)
READ_NEAR_DISPLACED(4)
layout(std430, binding = 5) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 6) buffer HistogramBlock { uint histogram[]; };  // compression; then inside the fluid: above, below rest density
layout(std430, binding = 7) buffer VelocityBlock { vec4 velocity[]; };    // w: density over rest density
READ_UINT(8, listHead)

vec3 here;
float rho = 0.0;
uint within = 0u;  // particles, and images, nearer than the support
float support = params.support;

vec3 place;
void takeTurn(bool mine) { here = mine ? place : vec3(-kInactivePosition); }  // from there nothing is near
void candidates(uint first, uint end) {
  uint base = first;
  LOOP_WHILE (ANY_LANE(base < end)) {
    vec3 candidate = base + clusterLane < end ? orderedPositionAt(base + clusterLane).xyz : vec3(kInactivePosition);
    for (uint lane = 0u; lane < CLUSTER; ++lane) {
      vec3 r = here - SPREAD(candidate, lane);
      float distance = sqrt(dot(r, r));
      rho += kernelShape(distance);
      within += uint(distance < support);
    }
    base += CLUSTER;
  } LOOP_END(ANY_LANE(base < end));
}
#include "fluid/walk.glsl"

uint binOf(float size) {
  return clamp(floatBitsToUint(size) >> 14, kMeasureFirst, kMeasureFirst + kMeasureBins - 1u) - kMeasureFirst;
}

void main() {
  uint slot = clusterInvocation();
  bool inRange = slot < control.count;
  vec4 particle = inRange ? orderedPositionAt(slot) : vec4(kInactivePosition);
  inRange = inRange && isActive(particle.xyz);
  place = particle.xyz;
  vec3 scaled = scaledPosition(place);
  uint inside = 0u;  // neighbors alone
  Images images = imagesNear(particle.xyz, support);
  bool more = inRange;
  LOOP_WHILE (subgroupAny(more)) {
    uint n = nextImage(images);
    vec3 signs;
    place = imageOf(n, particle.xyz, signs);
    walkGrid(scaled, scaled, more, support);
    if (n == 0u) inside = within;
    more = advance(images) && more;
  } LOOP_END(subgroupAny(more));
  if (!inRange) return;
  uint i = numberFromFloat(particle.w);
  rho *= densityScale();
  if (SOLIDS || MOUTHS) rho += displacedAt(i, listHeadAt(i)).w;
  velocity[i].w = rho;
  float error = rho - 1.0;
  if (error > 0.0) atomicAdd(histogram[binOf(error)], 1u);
  if (inside > params.fullNeighbors) atomicAdd(histogram[(error > 0.0 ? kMeasureBins : 2u * kMeasureBins) + binOf(abs(error))], 1u);
}
