#version 460
// Figures of the present instant: density at the positions (walls included), energies, momentum, who is outside; a partial sum a workgroup in a
// fixed order, and histograms of the density error for its percentiles. Walks a grid of its own, made of the positions: no neighbour that the solver's
// list has missed is missed here.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"
#include "shared/arrays.glsl"
layout(local_size_x = kMeasureGroup) in;
layout(constant_id = 2) const uint NEAR = 0;
READ_FLOAT4(2, sorted)  // w: the particle's place in the solver's arrays, as a number
READ_UINT(3, cellStart)
READ_FLOAT4(4, nearSample)
layout(std430, binding = 5) writeonly buffer PartialBlock { MeasurePartial partials[]; };
layout(std430, binding = 6) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 7) buffer HistogramBlock { uint histogram[]; };  // compression; then inside the fluid: above, below rest density
layout(std430, binding = 8) buffer VelocityBlock { vec4 velocity[]; };

vec3 here;
float rho = 0.0;
uint inside = 0u;
float support = params.support;

vec3 place;
void takeTurn(bool mine) { here = mine ? place : vec3(-kParked); }  // from there nothing is near
void candidates(uint first, uint end) {
  for (uint base = first; base < end; base += CLUSTER) {
    vec3 candidate = base + clusterLane < end ? sortedAt(base + clusterLane).xyz : vec3(kParked);
    for (uint lane = 0u; lane < CLUSTER; ++lane) {
      vec3 r = here - SPREAD(candidate, lane);
      float distance = sqrt(dot(r, r));
      rho += kernelShape(distance);
      inside += uint(distance < support);
    }
  }
}
#include "fluid/walk.glsl"

shared MeasurePartial rows[kMeasureGroup];

uint binOf(float size) {
  return clamp(floatBitsToUint(size) >> 14, kMeasureFirst, kMeasureFirst + kMeasureBins - 1u) - kMeasureFirst;
}

void main() {
  uint slot = clusterInvocation();
  uint lane = slot % kMeasureGroup;
  MeasurePartial mine = MeasurePartial(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0u, 0u, 0u);
  bool there = slot < params.count;
  vec4 particle = there ? sortedAt(slot) : vec4(0.0);
  bool parked = particle.x >= kParked * 0.5;
  place = particle.xyz;
  vec3 scaled = scaledPosition(place);
  walkGrid(scaled, scaled, there && !parked, support);
  here = place;
  if (there && parked) {
    mine.outside = 1u;
    mine.parked = 1u;
  } else if (there) {
    uint i = uint(particle.w);
    rho *= params.valueScale;
    if (NEAR != 0u) rho += nearSampleAt(i).w;
    vec3 v = velocity[i].xyz;
    velocity[i] = vec4(v, rho);
    float error = rho - 1.0;
    mine.compression = max(error, 0.0);
    mine.compressionMax = mine.compression;
    mine.kinetic = dot(v, v);
    mine.speedMax = sqrt(mine.kinetic);
    mine.velocityX = v.x;
    mine.velocityY = v.y;
    mine.velocityZ = v.z;
    mine.positionX = here.x;
    mine.positionY = here.y;
    mine.positionZ = here.z;
    vec3 low = vec3(params.boundLowX, params.boundLowY, params.boundLowZ), high = vec3(params.boundHighX, params.boundHighY, params.boundHighZ);
    mine.outside = uint(any(lessThan(here, low)) || any(greaterThan(here, high)));
    if (error > 0.0) atomicAdd(histogram[binOf(error)], 1u);
    if (inside > params.fullNeighbours) {
      mine.counted = 1u;
      atomicAdd(histogram[(error > 0.0 ? kMeasureBins : 2u * kMeasureBins) + binOf(abs(error))], 1u);
    }
  }
  rows[lane] = mine;
  for (uint half_ = kMeasureGroup / 2u; half_ > 0u; half_ /= 2u) {
    barrier();
    if (lane < half_) {
      MeasurePartial a = rows[lane], b = rows[lane + half_];
      rows[lane] = MeasurePartial(a.compression + b.compression, max(a.compressionMax, b.compressionMax), a.kinetic + b.kinetic, max(a.speedMax, b.speedMax),
                                  a.velocityX + b.velocityX, a.velocityY + b.velocityY, a.velocityZ + b.velocityZ, a.positionX + b.positionX,
                                  a.positionY + b.positionY, a.positionZ + b.positionZ, a.outside + b.outside, a.counted + b.counted, a.parked + b.parked);
    }
  }
  if (lane == 0u) partials[flatGroup()] = rows[0];
}
