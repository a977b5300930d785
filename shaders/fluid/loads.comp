#version 460
// Sums of the displacements that solids give the particles near them by the density that they displace;
// collide.comp adds contacts. The reaction on a solid is their opposite: what the fluid got, reversed.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "fluid/uniforms.glsl"
#include "fluid/images.glsl"
#include "shared/loops.glsl"
#include "shared/arrays.glsl"
READ_UINT(9, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
READ_UINT4(3, nearSolids)
#include "fluid/near_solids.glsl"
layout(local_size_x = kFluidGroup) in;

READ_UINT4(2, work)        // the prediction that the density is of
layout(std430, binding = 4) readonly buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(5, table)
READ_UINT4(6, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
READ_UINT2(7, nearMultipliers)  // two floats
layout(std430, binding = 8) buffer SolidSumsBlock { uint solidSums[]; };
READ_UINT(10, nearSampled)  // of solids.comp, at the same places
READ_UINT(11, listHead)
#include "fluid/sleeping.glsl"
#include "fluid/solid_density.glsl"
#include "fluid/solid_reaction.glsl"

// Sums of a solid: of the solve in the first components, of the warm start in the others.
struct Reaction {
  float units[2u * kLoadComponents];
};

void add(inout Reaction r, vec3 center, vec3 solve, vec3 warm, vec3 at) {
  float one[kLoadComponents], other[kLoadComponents];
  toUnits(center, solve, at, one);
  toUnits(center, warm, at, other);
  for (uint c = 0u; c < kLoadComponents; ++c) {
    r.units[c] += one[c];
    r.units[c + kLoadComponents] += other[c];
  }
}

// What a solid gives a particle at x, whose multipliers are those of the solve and of the warm start.
void addSolid(inout Reaction r, SolidRecord s, vec3 x, vec2 multipliers) {
  Images images = imagesNear(x, params.support);
  bool more = true;
  LOOP_WHILE (more) {
    vec3 signs, image = imageOf(nextImage(images), x, signs);
    vec3 gradient = solidSample(s, image).xyz;
    if (gradient != vec3(0.0)) {
      gradient *= shareOfImage(s, image);
      add(r, centerOf(s.pose), multipliers.x * gradient, multipliers.y * gradient, image);
    }
    more = advance(images);
  } LOOP_END(more);
}

uint lane = 0u, lanes = 1u;  // among those of the subgroup that are there

// By all lanes; `mine`: the lane has something for solid k, which is the same for these lanes. Each lane adds some of the totals: CPU
// drivers execute an atomic addition for all lanes, one by one.
void addToSums(uint k, Reaction r, bool mine) {
  const uint kSums = 2u * kLoadComponents;
  int high[kSums];
  uint low[kSums];
  for (uint c = 0u; c < kSums; ++c) {
    split(mine ? r.units[c] : 0.0, high[c], low[c]);
    high[c] = subgroupAdd(high[c]);
    low[c] = subgroupAdd(low[c]);
  }
  for (uint first = 0u; first < kSums; first += lanes) {
    uint own = first + lane, lowOfOwn = 0u;
    int highOfOwn = 0;
    for (uint c = 0u; c < kSums; ++c) {
      if (c != own) continue;
      highOfOwn = high[c];
      lowOfOwn = low[c];
    }
    addWide(k * kSolidSumWords + 2u * min(own, kSums - 1u), highOfOwn, lowOfOwn);
  }
}

void main() {
  if (control.phase == kPhaseSettling) return;  // by all: nothing moves in time
  uint n = flatInvocation();
  bool inRange = n < sums.nearSolids;
  NearSolids near = nearSolidsOf(inRange ? n : 0u);
  uint i = near.particle;
  inRange = inRange && !isAsleep(i);
  vec3 x = uintBitsToFloat(workAt(i).xyz);
  vec2 multipliers = uintBitsToFloat(nearMultipliersAt(i));
  if (control.phase != kPhaseAdvancing) multipliers.x = 0.0;

  near.mask = nearSampledAt(inRange ? n : 0u);

  lanes = subgroupAdd(1u);
  lane = subgroupExclusiveAdd(1u);
  // By solids that any lane has, not by each lane's own next one: then a solid's sums take one addition a subgroup.
  uint m = 0u, k = 0u;
  bool more = inRange && isActive(x) && nextSolid(near, m, k);
  LOOP_WHILE (subgroupAny(more)) {
    uint least = subgroupMin(more ? k : kNoSolid);
    bool mine = more && k == least;
    Reaction r;
    for (uint c = 0u; c < 2u * kLoadComponents; ++c) r.units[c] = 0.0;
    if (mine) addSolid(r, solidAt(least), x, multipliers);
    addToSums(least, r, mine);
    if (mine) {
      ++m;
      more = nextSolid(near, m, k);
    }
  } LOOP_END(subgroupAny(more));
}
