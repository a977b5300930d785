// Sums over the neighbors of a particle: from its list, or by walking the grid where there is no
// list or it overflowed. Only the variant WALKS can walk; the device dispatches it in place of the
// other while a list is full (the unused code costs an eighth of the time on lavapipe). Before it
// includes this the shader includes fluid/arrays.glsl, defines `vec3 here`, the particle's place,
// and `void visit(PARTICLE particle)`, and binds at 2 the array whose elements are handed over; with
// COMPANION(j) defined, `void visit(PARTICLE particle, vec4 companion)`. Particles beyond the support
// and dummies are visited too. With IMAGES defined, also the images of the particle and its neighbors
// behind walls (fluid/images.glsl), for which the shader defines `void reflectSums(vec3 signs)`. Far
// neighbors of a fluid with surface tension are left out.
#ifndef RILL_NEIGHBORS_GLSL
#define RILL_NEIGHBORS_GLSL
#include "shared/loops.glsl"
#include "fluid/images.glsl"

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

#ifndef WALK_REACH
#define WALK_REACH params.nearReach
#endif

#ifdef COMPANION
#define VISIT(j, particle) visit(particle, COMPANION(j))
#else
#define VISIT(j, particle) visit(particle)
#endif

uint dummy = params.capacity;  // loaded once, see kernel.glsl

// The neighbor that an entry of the list leads to from neighbor j, or the dummy; moves j on.
uint longStep(uint entry) { return uint(int(entry << 20) >> (20 - kLongStepShift)); }
uint nextNeighbor(inout uint j, uint entry) {
  bool isLong = entry >= kLongStep;
  j += isLong ? longStep(entry) : entry;
  return isLong ? dummy : j;
}

// The list head of particle i; of none if it is not `inRange`.
uint headOf(uint i, bool inRange) {
  return (LIST_CAPACITY != 0u || SOLIDS || MOUTHS || REGIONS) && inRange ? listHeadAt(i) : 0u;
}

// Whether the particle with this head is in a region that sleeps: it stays where it is.
bool sleeps(uint head) { return REGIONS && (head & kAsleepBit) != 0u; }
bool isNearSolids(uint head) { return SOLIDS && (head & kNearSolidsBit) != 0u; }
bool gathersAsleep() { return REGIONS && control.regionTime <= 1.01 * control.step; }  // what sleeps, once for each list

#ifndef IMAGES
void reflectSums(vec3 signs) {}
#endif

// Groups of the far segment that the list at `at` begins with.
uint farGroups(uint at) {
  uint segment = listAt(at).x & 0xfffu;
  return segment >> kSegmentGroupBits >= kDeepSegment ? segment & kMaxSegmentGroups : 0u;
}

// Visits the particles of the list of particle i, at invocation `local` of its chunk.
void visitListed(uint i, uint head, uint local) {
  uint count = head & kUnlisted;
  uint at = firstGroup(local);
  uint groups = count == kUnlisted ? 0u : (count + 3u) / 4u;
  uint first = i - (head >> kHeadDistanceShift);
  uint k = 0u;
  vec3 from = here;
  if (TENSION && (head & kSegmentsBit) != 0u) {  // far neighbors come first
    k = farGroups(at);
    at += k * kListBlock;
  }
  LOOP_WHILE (k < groups) {
    uint end = groups, j = first;
    vec3 signs = vec3(1.0);
    if ((WALLS || TENSION) && (head & kSegmentsBit) != 0u) {
      uint segment = listAt(at).x & 0xfffu, image = segment >> kSegmentGroupBits;
      end = k + max(segment & kMaxSegmentGroups, 1u);
#ifdef IMAGES
      here = imageOf(image, from, signs);
#else
      if (image != 0u) groups = end = k;
#endif
      j -= longStep(segment);  // the segment's first entry is read as a step, too
    }
    reflectSums(signs);
    LOOP_WHILE (k < end) {
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
    } LOOP_END(k < end);
    reflectSums(signs);
  } LOOP_END(k < groups);
  here = from;
}

// Visits what is around the cells that particle i was sorted by, if it `walks`. All lanes of a cluster call this.
void visitAround(uint i, bool walks) {
  vec3 home = cellFromKey(cellAt(walks ? i : 0u)), from = here;
  Images images = imagesNear(from, params.support);
  bool more = walks;
  LOOP_WHILE (subgroupAny(more)) {
    uint n = nextImage(images);
    vec3 signs;
    place = imageOf(n, from, signs);
    self = n == 0u ? i : 0xffffffffu;
    reflectSums(signs);
    walkGrid(home, home + 1.0, more, WALK_REACH);
    reflectSums(signs);
#ifdef IMAGES
    more = advance(images) && more;
#else
    more = false;
#endif
  } LOOP_END(subgroupAny(more));
  here = from;
}

// Visits the neighbors of particle i, if `inRange`, at invocation `local` of its chunk; with IMAGES theirs
// and its own images, too. All lanes of a cluster call this.
void visitNeighbors(uint i, uint head, uint local, bool inRange) {
  bool listed = LIST_CAPACITY != 0u && (head & kUnlisted) != kUnlisted;
  if (LIST_CAPACITY != 0u) visitListed(i, head, local);
  if (WALKS) visitAround(i, inRange && !listed && isActive(here));
}
#endif
