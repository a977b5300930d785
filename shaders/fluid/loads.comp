#version 460
// Sums of the displacements that solids give the particles near them by the density that they displace;
// collide.comp adds contacts. The reaction on a solid is their opposite: what the fluid got, reversed.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require
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

const uint kSums = 2u * kLoadComponents;

// By all lanes; `mine`: the lane has something for solid k, which is the same for these lanes. In each of two steps a lane hands half of
// its sums to a lane that has the other half, then what is left is added up: a third of the work of a sum over the subgroup for each.
void addToSums(uint k, Reaction r, bool mine) {
  ivec2 sum[kSums];  // high, low
  for (uint c = 0u; c < kSums; ++c) {
    uint low;
    split(mine ? r.units[c] : 0.0, sum[c].x, low);
    sum[c].y = int(low);
  }
  bool odd = (gl_SubgroupInvocationID & 1u) != 0u, upper = (gl_SubgroupInvocationID & 2u) != 0u;
  for (uint c = 0u; c < kSums / 2u; ++c) {
    ivec2 given = odd ? sum[c] : sum[c + kSums / 2u];
    sum[c] = (odd ? sum[c + kSums / 2u] : sum[c]) + subgroupShuffleXor(given, 1u);
  }
  for (uint c = 0u; c < kSums / 4u; ++c) {
    ivec2 given = upper ? sum[c] : sum[c + kSums / 4u];
    sum[c] = (upper ? sum[c + kSums / 4u] : sum[c]) + subgroupShuffleXor(given, 2u);
  }
  uint first = (odd ? kSums / 2u : 0u) + (upper ? kSums / 4u : 0u);
  for (uint c = 0u; c < kSums / 4u; ++c) {
    if (CLUSTER > 4u) sum[c] += subgroupShuffleXor(sum[c], 4u);  // a loop would leave the sums in memory
    if (CLUSTER > 8u) sum[c] += subgroupShuffleXor(sum[c], 8u);
    if (CLUSTER > 16u) sum[c] += subgroupShuffleXor(sum[c], 16u);
  }
  if ((gl_SubgroupInvocationID & (CLUSTER - 1u)) < 4u)
    for (uint c = 0u; c < kSums / 4u; ++c) addWide(k * kSolidSumWords + 2u * (first + c), sum[c].x, uint(sum[c].y));
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
