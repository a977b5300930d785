#version 460
// Surface tension, first pass: how far each sample around a particle is covered, and what follows from it: its weight times 1 - c, and
// the force where the weight changes at walls and solids. See engine/sph/surface_tension.hpp. By positions at the end of the substep.
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/surface_samples.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
layout(std430, binding = 8) writeonly buffer SampleBlock { uvec2 surfaceSample[]; };
layout(std430, binding = 9) writeonly buffer ExposedBlock { float exposed[]; };  // tension of particles with exposed samples, else 0
layout(std430, binding = 10) buffer VelocityBlock { vec4 velocity[]; };
READ_FLOAT4(11, solidPlane)  // xyz: away from the nearest solid, w: distance in m

vec3 here;
uvec4 coverOfFluids;
Samples covered = ofAll(0.0);

void visit(vec4 particle) {
  Samples near = nearness(particle.xyz - here);
  if (INTERFACES) {
    float cover = coverBy(coverOfFluids, fluidOfPosition(particle));
    EACH_PART(k) covered.part[k] += cover * near.part[k] * near.part[k] * near.part[k];
    return;
  }
  EACH_PART(k) covered.part[k] += near.part[k] * near.part[k] * near.part[k];
}
#include "fluid/neighbors.glsl"

// Whether no sample can be exposed: the list is that of a particle in the middle of others.
bool isDeep(uint head) {
  uint count = head & kUnlisted;
  return LIST_CAPACITY != 0u && count != kUnlisted && count >= params.deepNeighbors && (head & (kSegmentsBit | kNearSolidsBit)) == 0u;
}

// Whether the particle's fluid has tension with another one, which may be anywhere around.
bool hasInterface() { return INTERFACES && coverOfFluids != uvec4(0xffffffffu); }

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

// Weights the samples by how near they are to walls and solids; the force where the weight changes.
vec3 weigh(inout Samples open, vec4 solid) {
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
  for (uint n = 0u; n < kPlanes; ++n) {
    vec4 plane = planeAt(n, solid);
    if (!reaches(plane)) continue;
    Samples by = distances(plane);
    float sum = 0.0;
    EACH_PART(k) {
      vec4 mine = vec4(equal(by.part[k], nearest.part[k]));
      sum += dot(mine, slope.part[k]);
      slope.part[k] *= 1.0 - mine;
    }
    force -= sum * plane.xyz;
  }
  return force;
}

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < min(push.last, control.solved);
  if (!inRange) i = params.capacity;
  vec4 particle = particleAt(i);
  here = particle.xyz;
  uint head = headOf(i, inRange);
  if (INTERFACES) coverOfFluids = coverRow(fluidOfPosition(particle));
  bool looks = inRange && isActive(here) && !sleeps(head) && (hasInterface() || !isDeep(head));
  visitNeighbors(i, looks ? head : 0u, local, looks);
  if (i == 0u) exposed[params.capacity] = 0.0;  // the dummy neighbor
  if (!inRange) return;
  float largest = 0.0, tension = 0.0;
  if (looks) {
    Samples open;
    EACH_PART(k) open.part[k] = max(1.0 - kTensionAmplitude * covered.part[k], vec4(0.0));
    uint fluid = fluidOfPosition(particle);
    tension = tensionOf(fluid);
    if (WALLS || SOLIDS) {
      bool nearSolids = SOLIDS && (head & kNearSolidsBit) != 0u;
      vec3 force = weigh(open, nearSolids ? solidPlaneAt(i) : vec4(0.0, 1.0, 0.0, kNoWall));
      velocity[i].xyz += control.step * params.tensionWall * tension * inverseMassOf(fluid) * force;
    }
    EACH_PART(k) {
      vec4 stored = open.part[k], sizes = abs(stored);
      largest = max(largest, max(max(sizes.x, sizes.y), max(sizes.z, sizes.w)));
      surfaceSample[i * kSampleParts + k] = uvec2(packHalf2x16(stored.xy), packHalf2x16(stored.zw));
    }
  }
  exposed[i] = largest > kLeastExposure ? tension : 0.0;
}
