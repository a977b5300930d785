// Sums over the neighbors of a particle: from its list, or by walking the grid where there is no
// list or it overflowed. Only the variant WALKS can walk; the device dispatches it in place of the
// other while a list is full (the unused code costs an eighth of the time on lavapipe). Before it
// includes this the shader includes fluid/arrays.glsl, defines `vec3 here`, the particle's place,
// and `void visit(PARTICLE particle)`, and binds at 2 the array whose elements are handed over; with
// COMPANION(j) defined, `void visit(PARTICLE particle, vec4 companion)`. Particles beyond the support
// and dummies are visited too.
#ifndef RILL_NEIGHBORS_GLSL
#define RILL_NEIGHBORS_GLSL
#include "shared/loops.glsl"

READ_UINT(6, cellStart)
#ifdef MERGED
layout(std430, binding = 7) coherent buffer SumsBlock { FluidSums sums; };
#else
layout(std430, binding = 7) buffer SumsBlock { FluidSums sums; };
#endif

vec3 place;
uint self;
void takeTurn(bool mine) { here = mine ? place : vec3(-kInactivePosition); }  // from there nothing is near
vec4 asInactive(vec4 particle) { return vec4(vec3(kInactivePosition), particle.w); }
uvec4 asInactive(uvec4 particle) { return uvec4(floatBitsToUint(vec3(kInactivePosition)), particle.w); }
void candidates(uint first, uint end) {
  uint base = first;
  LOOP_WHILE (ANY_LANE(base < end)) {
    uint j = base + clusterLane < end ? base + clusterLane : params.capacity;
    PARTICLE particle = particleAt(j);
#ifdef COMPANION
    vec4 companion = COMPANION(j);
#endif
    for (uint lane = 0u; lane < CLUSTER; ++lane) {
      PARTICLE other = SPREAD(particle, lane);
      if (base + lane == self) other = asInactive(other);
#ifdef COMPANION
      visit(other, SPREAD(companion, lane));
#else
      visit(other);
#endif
    }
    base += CLUSTER;
  } LOOP_END(ANY_LANE(base < end));
}
#include "fluid/walk.glsl"

#ifdef COMPANION
#define VISIT(j, particle) visit(particle, COMPANION(j))
#else
#define VISIT(j, particle) visit(particle)
#endif

uint dummy = params.capacity;  // loaded once, see kernel.glsl

// The neighbor that an entry of the list leads to from neighbor j, or the dummy; moves j on.
uint nextNeighbor(inout uint j, uint entry) {
  bool isLong = entry >= kLongStep;
  j += isLong ? uint(int(entry << 20) >> (20 - kLongStepShift)) : entry;
  return isLong ? dummy : j;
}

// The list head of particle i; of none if it is not `inRange`.
uint headOf(uint i, bool inRange) {
  return (LIST_CAPACITY != 0u || NEAR) && inRange ? listHeadAt(i) : 0u;
}

// Visits the neighbors of particle i, if `inRange`, at invocation `local` of its chunk. All lanes
// of a cluster call this.
void visitNeighbors(uint i, uint head, uint local, bool inRange) {
  uint count = head & kUnlisted;
  bool listed = LIST_CAPACITY != 0u && count != kUnlisted;
  if (LIST_CAPACITY != 0u) {
    uint at = (local / kListBlock) * (kListBlock * (LIST_CAPACITY / 4u)) + local % kListBlock;
    uint groups = listed ? (count + 3u) / 4u : 0u;
    uint j = i - (head >> kHeadDistanceShift);
    uint k = 0u;
    LOOP_WHILE (k < groups) {
      uvec2 entries = listAt(at);
      uint x = nextNeighbor(j, entries.x & 0xffffu), y = nextNeighbor(j, entries.x >> 16);
      uint z = nextNeighbor(j, entries.y & 0xffffu), w = nextNeighbor(j, entries.y >> 16);
      PARTICLE atX = particleAt(x), atY = particleAt(y), atZ = particleAt(z), atW = particleAt(w);
      VISIT(x, atX);
      VISIT(y, atY);
      VISIT(z, atZ);
      VISIT(w, atW);
      at += kListBlock;
      ++k;
    } LOOP_END(k < groups);
  }
  if (!WALKS) return;
  bool walks = inRange && !listed && isActive(here);
  vec3 home = cellFromKey(cellAt(inRange ? i : 0u));
  place = here;
  self = i;
  walkGrid(home, home + 1.0, walks, params.reach);
  here = place;
}
#endif
