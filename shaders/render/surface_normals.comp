#version 460
// Normals of a filtered depth, by differences that do not cross depth edges.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

#include "render/surface_arrays.glsl"
READ_FLOAT(2, filtered)
READ_UINT(3, depth)
layout(std430, set = 0, binding = 4) writeonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(std430, set = 0, binding = 5) buffer Counters { uint counters[]; };
#define BLOCKS 6
#include "render/surface_block.glsl"
#include "render/surface_coverage.glsl"
#include "render/surface_interior.glsl"

const float kInset = 0.3;  // spacings: smoothed spheres of 0.9 spacings lie this far above the surface, which is 0.5 above the centers

vec3 pointAt(ivec2 p, ivec2 grid, out bool valid) {
  valid = all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, grid));
  const float z = valid ? filteredAt(uint(p.y * grid.x + p.x)) : noDepth();
  valid = valid && z < noDepth();
  const vec2 axis = axisOf(samplePixel(p));
  return rayFrom(axis) + (valid ? z : 0.0) * rayAlong(axis);
}

vec3 difference(ivec2 p, ivec2 along, ivec2 grid, vec3 own) {
  bool before_valid, after_valid;
  const vec3 before = own - pointAt(p - along, grid, before_valid), after = pointAt(p + along, grid, after_valid) - own;
  if (before_valid && after_valid) {
    const float edge = 0.5 * view.spacing;
    // Central difference on one surface, at an edge the smaller one.
    if (abs(before.z - after.z) < edge) return before + after;
    return abs(before.z) < abs(after.z) ? before : after;
  }
  if (before_valid) return before;
  if (after_valid) return after;
  const float length = metersAPixel(own.z) * float(view.step);
  return vec3(vec2(along), 0.0) * length;
}

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const float z = filteredAt(index);
  if (z >= noDepth()) return;
  const float hard = uintBitsToFloat(depthAt(index));
  const vec2 axis = axisOf(samplePixel(p));
  if (!isInterior(p)) {
    const float coverage = coverageFromCenters(axis, hard);
    if (bound_hit) atomicAdd(counters[kBoundHits], 1u);
    if (coverage < 0.5) return;
  }
  if (hard <= nearestDrawn()) {
    samples[index] = cutSample(axis);
    return;
  }
  bool valid;
  const vec3 own = pointAt(p, grid, valid);
  vec3 normal = cross(difference(p, ivec2(1, 0), grid, own), difference(p, ivec2(0, 1), grid, own));
  const vec3 towards = view.perspective > 0.0 ? own : vec3(0.0, 0.0, 1.0);
  if (dot(normal, towards) > 0.0) normal = -normal;
  const float size = length(normal);
  normal = size > 0.0 ? normal / size : -normalize(towards);
  // The spheres extend beyond the fluid's surface.
  const float slope = dot(rayAlong(axis), normal);
  const float inset = min(kInset / max(-slope, 0.1), 3.0 * kInset) * view.spacing;
  samples[index] = uvec2(floatBitsToUint(max(z + inset, nearestDrawn())), packNormal(normal));
}
