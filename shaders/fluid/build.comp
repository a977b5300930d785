#version 460
// The neighbor list of the sorted particles (those nearer than a support plus skin), as described in
// shared/neighbor_list.h, and the sorted arrays copied back in place. A particle with more entries than
// the list holds walks the grid in every pass, and is counted. Gathers from the sorted predictions.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "fluid/images.glsl"
#include "fluid/cluster.glsl"
#include "shared/arrays.glsl"
READ_UINT(17, meshWord)
#define MESH_WORDS
#include "shared/loops.glsl"
#include "shared/number.glsl"
#include "shared/pair_hash.h"
layout(local_size_x = kFluidGroup) in;

layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(2, sortedPrediction)
layout(std430, binding = 3) writeonly buffer ListBlock { uvec2 list[]; };
layout(std430, binding = 4) writeonly buffer HeadBlock { uint listHead[]; };
layout(std430, binding = 5) writeonly buffer KeyBlock { uint cell[]; };
READ_UINT(6, cellStart)
layout(std430, binding = 7) buffer SumsBlock { FluidSums sums; };
#include "fluid/columns.glsl"
READ_FLOAT4(8, sortedPosition)  // w: the id
READ_FLOAT4(9, sortedVelocity)  // w: the warm start
layout(std430, binding = 10) writeonly buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 11) writeonly buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 12) writeonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 13) writeonly buffer WarmBlock { float warm[]; };
layout(std430, binding = 14) writeonly buffer IdBlock { uint id[]; };
layout(std430, binding = 15) writeonly buffer NearSolidsBlock { uvec4 nearSolids[]; };
READ_UINT4(16, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
#include "shared/solid_records.h"
#include "fluid/cull_solids.glsl"
#include "fluid/list_solids.glsl"
#include "shared/region_records.h"

const uint kNone = 0xffffffffu;

uint self;

// Entries are stored four at a time: lavapipe stores lane by lane, so fewer and wider stores are faster.
uvec2 held;
uint holds = 0u;
uint stored = 0u;  // entries
uint at;
uint headDistance = 0u;  // see the list head
uint last = kNone;       // the neighbor that was listed last
bool begun = false;      // a neighbor has set headDistance

void hold(uint k, uint entry) {
  held[k / 2u] = k % 2u == 0u ? entry : held[k / 2u] | entry << 16;
  holds = k + 1u;
}

// The segment in progress: where it begins, and its first group, whose first entry is known at its end.
uint segmentAt, segmentBegin = 0u;
uvec2 segmentHeld;

void store() {
  if (stored < LIST_CAPACITY) list[at] = held;
  if (stored == segmentBegin) segmentHeld = held;
  at += kListBlock;
  stored += holds;
  holds = 0u;
}

// Fills the last group.
void padAndStore() {
  for (uint k = 1u; k < 4u; ++k)
    if (holds == k) hold(k, kLongStep);
  if (holds == 4u) store();
}

void beginSegment() {
  segmentAt = at;
  segmentBegin = stored;
  hold(0u, kLongStep);
  last = kNone;
}

void endSegment(uint image) {
  if (last == kNone && image < kDeepSegment) holds = 0u;  // drop a segment without neighbors
  padAndStore();
  uint groups = (stored - segmentBegin) / 4u;
  uint entry = kLongStep | image << kSegmentGroupBits | groups;
  if (groups > 0u && stored <= LIST_CAPACITY) list[segmentAt] = uvec2((segmentHeld.x & 0xffff0000u) | entry, segmentHeld.y);
}

// Goes on to a neighbor near enough to `j` for one step to it.
void approach(uint j) {
  if (!begun) {
    headDistance = min(self - min(self, j), kMaxHeadDistance);
    begun = true;
  }
  if (last == kNone) last = self - headDistance;
  if (j - last < kLongStep) return;
  uint far = uint(int(j - last) >> kLongStepShift), next = holds;
  for (uint k = 0u; k < 4u; ++k)
    if (next == k) hold(k, kLongStep | (far & 0xfffu));
  if (holds == 4u) store();
  last += far << kLongStepShift;
}

// Particles base + k for the bits k of `mask`.
void listNeighbors(uint base, uint mask) {
  if (mask != 0u) approach(base + findLSB(mask));
  LOOP_WHILE (mask != 0u) {
    for (uint k = 0u; k < 4u; ++k) {
      if (holds != k || mask == 0u) continue;
      uint j = base + findLSB(mask);
      mask &= mask - 1u;
      hold(k, j - last);
      last = j;
    }
    if (holds == 4u) store();
  } LOOP_END(mask != 0u);
}

bool listable = true;  // a list can hold the neighbors
uint image = 0u;  // behind walls, whose neighbors come next; 0: the particle; kFarSegment: its far neighbors
vec3 place, here;
uint coincident = kNone;
float nearSquared = params.nearReach * params.nearReach;
float reachSquared = nearSquared;
uint around = 0u;  // neighbors within params.reach that cover samples of the surface whole
uint ownFluid;
bool hasInterface = false;  // with its fluid
float coincidentSquared = 1.0e-6 * params.support * params.support;

void takeTurn(bool mine) { here = mine ? place : vec3(-kInactivePosition); }  // from there nothing is near
void candidates(uint first, uint end) {
  uint mask = 0u, coincidents = 0u, inner = 0u, own = 0u;
  uint base = first;
  LOOP_WHILE (ANY_LANE(base < end)) {
    vec4 candidate = sortedPredictionAt(min(base + clusterLane, max(end, 1u) - 1u));
    uint near = 0u, same = 0u, closer = 0u, alike = 0u;
    for (uint lane = 0u; lane < CLUSTER; ++lane) {
      vec3 r = here - SPREAD(candidate.xyz, lane);
      float squared = dot(r, r);
      near |= uint(squared < reachSquared) << lane;
      same |= uint(squared < coincidentSquared) << lane;
      if (TENSION) closer |= uint(squared < nearSquared) << lane;
      if (INTERFACES) alike |= uint(fluidOfPrediction(SPREAD(candidate.w, lane)) == ownFluid) << lane;
    }
    mask |= near << (base - first);
    coincidents |= same << (base - first);
    inner |= closer << (base - first);
    own |= alike << (base - first);
    base += CLUSTER;
  } LOOP_END(ANY_LANE(base < end));
  if (end - first < kWindow) mask &= (1u << (end - first)) - 1u;
  bool far = TENSION && image == kFarSegment;
  if ((image == 0u || far) && self - first < kWindow) mask &= ~(1u << (self - first));
  if (far) {
    around += bitCount(INTERFACES && hasInterface ? mask & own : mask);
    mask &= ~inner;
  }
  coincidents &= image == 0u ? mask : 0u;
  if (coincidents != 0u) coincident = first + findMSB(coincidents);
  if (LIST_CAPACITY != 0u) listNeighbors(first, listable ? mask : 0u);
}
#include "fluid/walk.glsl"

// Share of a ball around a place that is on the fluid's side of a wall; `distance`: of the place, over the ball's radius.
float shareBefore(float distance) {
  float t = clamp(distance, 0.0, 1.0);
  return 0.5 + (0.75 - 0.25 * t * t) * t;
}

// Whether so many are around a particle that no surface can be near but walls: see docs/notes/surface-tension.md.
bool isDeep(vec3 x) {
  vec3 low = x - wallsLow(), high = wallsHigh() - x;
  if (aboveOutflow(x)) {
    if (params.outflowSide % 2u == 0u) low[params.outflowSide / 2u] = kNoWall;
    else high[params.outflowSide / 2u] = kNoWall;
  }
  float share = 1.0;
  for (int a = 0; a < 3; ++a) share *= shareBefore(low[a] / params.reach) + shareBefore(high[a] / params.reach) - 1.0;
  return float(around) >= share * params.deepNeighbors;
}

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < min(push.last, control.count);
  if (!inRange) i = push.first;
  vec4 predicted = sortedPredictionAt(i);
  vec3 x = predicted.xyz;
  if (CULL_SOLIDS) cullSolids(x, inRange && isActive(x));

  at = firstGroup(local);
  place = x;
  self = i;
  uint zone = uint(max(-predicted.w, 0.0));  // of reorder.comp
  bool asleep = REGIONS && zone != kZoneMoves;
  vec3 scaled = scaledPosition(x);
  addToColumns(inRange, x);
  Images images = imagesNear(x, params.nearReach);
  bool more = inRange && isActive(x) && (!REGIONS || zone <= kZoneWatched), nearWall = more && images.near != uvec3(1u);
  listable = !(THIN && nearWall);  // a segment cannot name the images of thin domains: the particle walks the grid
  bool far = TENSION && LIST_CAPACITY != 0u;  // far neighbors come first
  bool segments = LIST_CAPACITY != 0u && listable && (nearWall || (TENSION && more));
  if (INTERFACES) {
    ownFluid = fluidOfPrediction(predicted.w);
    hasInterface = coverRow(ownFluid) != uvec4(0xffffffffu);
  }
  LOOP_WHILE (subgroupAny(more)) {
    vec3 signs;
    image = far ? kFarSegment : nextImage(images);
    place = far ? x : imageOf(image, x, signs);
    reachSquared = far ? params.reach * params.reach : nearSquared;
    if (segments && more) beginSegment();
    walkGrid(scaled, scaled, more, far ? params.reach : params.nearReach);
    if (segments && more) endSegment(far && isDeep(x) ? kDeepSegment : image);
    if (!far) more = segments && advance(images) && more;
    far = false;
  } LOOP_END(subgroupAny(more));
  if (REGIONS) {
    uint sleeping = subgroupAdd(uint(inRange && asleep));
    if (subgroupElect()) atomicAdd(sums.asleep, sleeping);
  }
  if (!inRange) return;
  cell[i] = cellKey(cellOf(x)) + (asleep && zone == kZoneAsleep ? cellCount() : 0u);
  uint head = 0u;
  if (LIST_CAPACITY != 0u) {
    uint all = stored + holds;
    padAndStore();
    // The walk for far neighbors may have left none for the near ones.
    bool fits = listable && all <= LIST_CAPACITY && !(TENSION && walked >= kWalkBound);
    head = (fits ? all : kUnlisted) | (segments ? kSegmentsBit : 0u) | headDistance << kHeadDistanceShift;
    if (!fits) atomicAdd(sums.overflow, 1u);
  }

  vec4 sorted = sortedPositionAt(i), moving = sortedVelocityAt(i);
  vec3 from = sorted.xyz;
  uint own = numberFromFloat(sorted.w);
  if (coincident != kNone) {  // coincident particles: a direction from both ids, opposite for the two
    uint other = numberFromFloat(sortedPositionAt(coincident).w);
    vec3 apart = vec3(pairDirection(own, other, 0u), pairDirection(own, other, 1u), pairDirection(own, other, 2u)) *
                 (0.02 / 1024.0 * params.spacing);
    x = insideWalls(x + apart);
    from = insideWalls(from + apart);
  }
  position[i] = vec4(from, storedFluid(fluidOfPrediction(predicted.w)));
  prediction[i] = vec4(x, predicted.w < 0.0 ? withFluid(0.0, fluidOfPrediction(predicted.w)) : predicted.w);
  velocity[i] = vec4(moving.xyz, 1.0);
  if (WARM) warm[i] = moving.w;
  id[i] = own;
  if (SOLIDS && listNear(i, x)) head |= kNearSolidsBit;
  if (asleep) head |= kAsleepBit;
  if (LIST_CAPACITY != 0u || SOLIDS || MOUTHS || REGIONS) listHead[i] = head;
}
