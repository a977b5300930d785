#version 460
// Surface particles are those whose disc is visible to a sufficient share. Counts them per cell of the screen grid.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 3) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) buffer Start { uint start[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Rank { uvec2 rank[]; };  // cell, rank in it

const float kOwnedShare = 0.03;  // of visible samples of a disc; less is a sliver between neighbors

shared uint inside[kSurfaceGroup], owned[kSurfaceGroup];  // samples of each invocation's disc; visible ones of them
uint visited = 0u, own = 0u;

void visitSample(vec3 center, float radius, ivec2 p) {
  const float t = sphereDepth(center, radius, axisOf(samplePixel(p)));
  if (t < 0.0) return;
  ++visited;
  if (t <= uintBitsToFloat(depth[uint(p.y) * sampleGrid().x + uint(p.x)]) + 1e-3 * view.spacing) ++own;
}
void beginVisit(uint owner) {}
void endVisit(uint owner) {
  if (visited > 0u) atomicAdd(inside[owner], visited);
  if (own > 0u) atomicAdd(owned[owner], own);
  visited = own = 0u;
}
#include "render/surface_visit.glsl"

void main() {
  const uint self = gl_LocalInvocationIndex, k = groupIndex() * kSurfaceGroup + self;
  inside[self] = owned[self] = 0u;
  const bool live = k < counters[kSurvivorCount];
  const vec3 center = live ? viewPoint(position[survivors[k]].xyz) : vec3(0.0);
  visitSphere(live, center, hardRadius(center.z));
  if (!live) return;
  uvec2 place = uvec2(kNotSurface);
  if (owned[self] > 0u && float(owned[self]) >= kOwnedShare * float(inside[self])) {
    const ivec2 cell = cellOf(pixelOf(center));
    // kept: computed anew elsewhere, the cell may come out as the next one by rounding
    place.x = uint(cell.y) * cellGrid().x + uint(cell.x);
    place.y = atomicAdd(start[place.x], 1u);
    atomicAdd(counters[kSurfaceCount], 1u);
  }
  rank[k] = place;
}
