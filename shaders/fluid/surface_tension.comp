#version 460
// Surface tension, second pass, over the particles near surfaces: how far each of their samples is covered, what
// follows from it, its weight times 1 - c, and the forces of the samples on the particle, on its neighbors, and of
// walls and solids, where the weight changes. See engine/sph/surface_tension.hpp. By positions at the end of the
// substep.
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/surface_list.glsl"
#include "fluid/surface_samples.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_UINT(8, surfaceParticle)
layout(std430, binding = 9) buffer ForceBlock { int surfaceForce[]; };
layout(std430, binding = 10) buffer VelocityBlock { vec4 velocity[]; };
// xyz: away from the nearest solid, w: distance in m. LOADS: then what that solid does to the samples, for surface_reactions.comp: w: the
// sum of what pushes them toward it, over tensionWall, xyz: that of their offsets, each times what pushes it, m.
layout(std430, binding = 11) buffer PlaneBlock { vec4 solidPlane[]; };

vec3 here;
uvec4 coverOfFluids;
Samples samples = ofAll(0.0);  // first how far they are covered, then their weight times 1 - c
float toUnits = 0.0;           // of a force over params.tensionRate, which is a length
ivec3 ownForce = ivec3(0);

float coverOf(vec4 particle) { return INTERFACES ? coverBy(coverOfFluids, fluidOfPosition(particle)) : 1.0; }

void cover(vec4 particle) {
  Samples near = nearness(particle.xyz - here);
  float by = coverOf(particle);
  EACH_PART(k) samples.part[k] += by * near.part[k] * near.part[k] * near.part[k];
}

// What the samples do to particle j; they feel the opposite.
void pull(uint j, vec4 particle) {
  vec3 apart = particle.xyz - here;
  Samples near = nearness(apart);
  EACH_PART(k) near.part[k] *= near.part[k] * samples.part[k];
  vec3 force = coverOf(particle) * toUnits * (sampleRadius * resultant(near) - total(near) * apart);
  ivec3 units = ivec3(roundEven(clamp(force, -kMaxTension, kMaxTension)));
  if (units == ivec3(0)) return;
  ownForce -= units;
  for (int a = 0; a < 3; ++a) atomicAdd(surfaceForce[3u * j + a], units[a]);
}

// Of the walk of the grid: the index of a particle in two parts, each exact in a float.
const uint kIndexPart = 4096u;
#define COMPANION(j) vec4(float((j) / kIndexPart), float((j) % kIndexPart), 0.0, 0.0)
bool pulls = false;
void visit(vec4 particle, vec4 companion) {
  if (pulls) pull(uint(companion.x) * kIndexPart + uint(companion.y), particle);
  else cover(particle);
}
#define WALK_REACH params.reach
#define SCATTERED
#include "fluid/neighbors.glsl"

// The list of a particle but for images: its far neighbors, then the near ones.
struct List {
  uint at, first, farGroups, groups;
};
List listOf(uint i, uint head, uint local) {
  uint count = head & kUnlisted, all = count == kUnlisted ? 0u : (count + 3u) / 4u;
  List l = List(firstGroup(local), i - (head >> kHeadDistanceShift), 0u, 0u);
  l.farGroups = min(farGroups(l.at), all);
  uint segment = listAt(l.at + min(l.farGroups, LIST_CAPACITY / 4u - 1u) * kListBlock).x & 0xfffu;
  bool near = l.farGroups < all && segment >> kSegmentGroupBits == 0u;
  l.groups = l.farGroups + (near ? segment : 0u);
  return l;
}

// The neighbors of group k of a list, from neighbor j on.
uvec4 group(List l, uint k, inout uint j) {
  uvec2 entries = listAt(l.at + k * kListBlock);
  if (k == 0u || k == l.farGroups) j = l.first - longStep(entries.x);  // the segment's first entry is read as a step, too
  uint x = nextNeighbor(j, entries.x & 0xffffu), y = nextNeighbor(j, entries.x >> 16);
  uint z = nextNeighbor(j, entries.y & 0xffffu), w = nextNeighbor(j, entries.y >> 16);
  return uvec4(x, y, z, w);
}

void coverByListed(List l) {
  uint k = 0u, j = l.first;
  LOOP_WHILE (k < l.groups) {
    uvec4 js = group(l, k, j);
    vec4 x = particleAt(js.x), y = particleAt(js.y), z = particleAt(js.z), w = particleAt(js.w);
    cover(x);
    cover(y);
    cover(z);
    cover(w);
    ++k;
  } LOOP_END(k < l.groups);
}

void pullListed(List l) {
  uint k = 0u, j = l.first;
  LOOP_WHILE (k < l.groups) {
    uvec4 js = group(l, k, j);
    vec4 x = particleAt(js.x), y = particleAt(js.y), z = particleAt(js.z), w = particleAt(js.w);
    pull(js.x, x);
    pull(js.y, y);
    pull(js.z, z);
    pull(js.w, w);
    ++k;
  } LOOP_END(k < l.groups);
}

// Planes that a sample can be near: those of the walls, then that of the nearest solid. xyz: away from it, w: distance of `here`, m.
const uint kPlanes = SOLIDS ? 7u : 6u;
vec4 planeAt(uint n, vec4 solid) {
  if (n == 6u) return solid;
  uint axis = n / 2u;
  vec3 normal = vec3(0.0);
  normal[axis] = n % 2u == 0u ? 1.0 : -1.0;
  bool open = aboveOutflow(here) && n == params.outflowSide;
  return vec4(normal, open ? kNoWall : (n % 2u == 0u ? here[axis] - wallsLow()[axis] : wallsHigh()[axis] - here[axis]));
}

Samples distances(vec4 plane) { return along(kTensionRadius * plane.xyz, plane.w / params.spacing); }  // spacings
bool reaches(vec4 plane) { return plane.w < (kTensionRadius + 1.0) * params.spacing; }

// Weights the samples by how near they are to walls and solids; the force where the weight changes, and what of it is the solid's.
vec3 weigh(inout Samples open, vec4 solid, out vec4 bySolid) {
  Samples nearest = ofAll(1.0);
  for (uint n = 0u; n < kPlanes; ++n) {
    vec4 plane = planeAt(n, solid);
    if (!reaches(plane)) continue;
    Samples by = distances(plane);
    EACH_PART(k) nearest.part[k] = min(nearest.part[k], by.part[k]);
  }
  float whole = 1.0 + params.wettingCosine;
  Samples slope;
  EACH_PART(k) {
    vec4 t = clamp(nearest.part[k], vec4(0.0), vec4(1.0)), free = open.part[k];
    slope.part[k] = whole * 6.0 * t * (1.0 - t) * free * free;
    open.part[k] = (whole * t * t * (3.0 - 2.0 * t) - params.wettingCosine) * free;
  }
  vec3 force = vec3(0.0);
  bySolid = vec4(0.0);
  for (uint n = 0u; n < kPlanes; ++n) {
    vec4 plane = planeAt(n, solid);
    if (!reaches(plane)) continue;
    Samples by = distances(plane);
    float sum = 0.0;
    EACH_PART(k) {
      vec4 mine = vec4(equal(by.part[k], nearest.part[k]));
      sum += dot(mine, slope.part[k]);
      by.part[k] = mine * slope.part[k];
      slope.part[k] *= 1.0 - mine;
    }
    force -= sum * plane.xyz;
    if (LOADS && n == 6u) bySolid = vec4(sampleRadius * resultant(by), sum);
  }
  return force;
}

// The weights of the samples times 1 - c, and the tension; whether a sample has any.
bool expose(uint i, uint head, uint fluid) {
  EACH_PART(k) samples.part[k] = max(1.0 - kTensionAmplitude * samples.part[k], vec4(0.0));
  if (WALLS || SOLIDS) {
    bool nearSolids = isNearSolids(head);
    vec4 bySolid;
    vec3 force = weigh(samples, nearSolids ? solidPlane[i] : vec4(0.0, 1.0, 0.0, kNoWall), bySolid);
    if (LOADS && nearSolids) solidPlane[i] = bySolid;
    velocity[i].xyz += control.step * params.tensionWall * tensionOf(fluid) * inverseMassOf(fluid) * force;
  }
  float sum = 0.0;
  EACH_PART(k) sum += dot(abs(samples.part[k]), vec4(1.0));
  toUnits = tensionOf(fluid) * kTensionUnits / params.spacing;
  return sum > 0.0 && toUnits > 0.0;
}

void main() {
  uint n = clusterInvocation();
  bool inRange = n < surfaceParticleAt(surfaceCounter(push.first));
  uint i = inRange ? surfaceParticleAt(push.first + n) : params.capacity, local = inRange ? i - push.first : 0u;
  vec4 particle = particleAt(i);
  here = particle.xyz;
  uint head = headOf(i, inRange), fluid = fluidOfPosition(particle);
  if (INTERFACES) coverOfFluids = coverRow(fluid);
  bool walks = WALKS && inRange && (LIST_CAPACITY == 0u || (head & kUnlisted) == kUnlisted);
  List list = List(0u, 0u, 0u, 0u);
  if (LIST_CAPACITY != 0u) list = listOf(i, head, local);
  if (LIST_CAPACITY != 0u) coverByListed(list);
  if (WALKS) visitAround(i, walks);
  if (inRange) pulls = expose(i, head, fluid);
  if (!pulls) list.groups = 0u;
  if (LIST_CAPACITY != 0u) pullListed(list);
  bool pulled = pulls;
  pulls = true;
  if (WALKS) visitAround(i, walks && pulled);
  if (!pulled) return;
  for (int a = 0; a < 3; ++a) atomicAdd(surfaceForce[3u * i + a], ownForce[a]);
}
