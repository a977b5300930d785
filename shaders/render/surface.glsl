// Camera, spheres and sample grid for all shaders of the surface.
#include "render/surface_records.h"
#include "shared/active.glsl"
#include "shared/dont_unroll.glsl"
#include "shared/no_depth.h"

#ifndef RILL_PUSH_MORE
#define RILL_PUSH_MORE
#endif
layout(push_constant) uniform Push {
  SurfacePush view;
  RILL_PUSH_MORE
};

#define groupIndex() (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x)  // compute shaders only

vec3 viewPoint(vec3 p) {
  return vec3(dot(vec3(view.rows[0], view.rows[1], view.rows[2]), p) + view.rows[3],
              dot(vec3(view.rows[4], view.rows[5], view.rows[6]), p) + view.rows[7],
              dot(vec3(view.rows[8], view.rows[9], view.rows[10]), p) + view.rows[11]);
}
// From view space to the space of stored positions; the rows are orthonormal.
vec3 worldDirection(vec3 v) {
  return vec3(view.rows[0], view.rows[1], view.rows[2]) * v.x + vec3(view.rows[4], view.rows[5], view.rows[6]) * v.y +
         vec3(view.rows[8], view.rows[9], view.rows[10]) * v.z;
}

vec3 worldPoint(vec3 v) { return worldDirection(v - vec3(view.rows[3], view.rows[7], view.rows[11])); }

vec2 pictureSize() { return vec2(float(view.width), float(view.height)); }
// Factor by which a pixel's extent grows with depth. Points in front of the near plane are treated as on it.
float widening(float z) { return view.perspective > 0.0 ? max(z, view.near_depth) : 1.0; }
// Just behind the near plane. Shaders compare each other's results, so it must be rounded alike in all.
float nearestDrawn() {
  precise float z = view.near_depth * 1.000001 + 1e-6 * view.spacing;
  return z;
}
vec2 axisOf(vec2 pixel) {
  return (pixel / pictureSize() * 2.0 - 1.0 - vec2(view.shift[0], view.shift[1])) * vec2(view.scale[0], view.scale[1]);
}
vec2 pixelOfAxis(vec2 axis) {
  return (axis / vec2(view.scale[0], view.scale[1]) + vec2(view.shift[0], view.shift[1]) + 1.0) * 0.5 * pictureSize();
}
vec2 pixelOf(vec3 p) { return pixelOfAxis(p.xy / widening(p.z)); }
float metersAPixel(float z) { return abs(view.scale[1]) * 2.0 / float(view.height) * widening(z); }

// A pixel's ray: from + z * along is the point at depth z.
vec3 rayFrom(vec2 axis) { return view.perspective > 0.0 ? vec3(0.0) : vec3(axis, 0.0); }
vec3 rayAlong(vec2 axis) { return view.perspective > 0.0 ? vec3(axis, 1.0) : vec3(0.0, 0.0, 1.0); }

// Depth of a sphere's near side along a ray, or of the near plane where it cuts the sphere; negative on a miss. Measured from the
// ray's point nearest to the center, which keeps the precision of small distant spheres.
float sphereDepth(vec3 center, float radius, vec2 axis) {
  const vec3 from = rayFrom(axis), along = rayAlong(axis);
  const float inverse = 1.0 / dot(along, along);
  const float middle = dot(center - from, along) * inverse;
  const vec3 miss = center - from - middle * along;
  const float inside = radius * radius - dot(miss, miss), half_chord = sqrt(max(inside, 0.0) * inverse), nearest = nearestDrawn();
  return inside > 0.0 && middle + half_chord > nearest ? max(middle - half_chord, nearest) : -1.0;
}

// Squared distance of a point to a ray.
float raySquare(vec3 point, vec2 axis) {
  const vec3 from = rayFrom(axis), along = rayAlong(axis);
  const vec3 miss = point - from - dot(point - from, along) / dot(along, along) * along;
  return dot(miss, miss);
}

// Bounds of a sphere that the near plane cuts: per axis the tangents that touch it behind the plane, and the ends of its section
// with the plane (Mara and McGuire 2013).
void cutExtent(vec3 center, float radius, out vec2 low, out vec2 high) {
  const vec2 from_eye = center.xy * center.xy + center.z * center.z, tangent = sqrt(max(from_eye - radius * radius, 0.0));
  const vec2 high_z = tangent * center.z - center.xy * radius, low_z = tangent * center.z + center.xy * radius;
  const vec2 beyond = view.near_depth * from_eye;  // the depth of a point of tangency is high_z or low_z times tangent / from_eye
  const float off = view.near_depth - center.z, section = sqrt(max(radius * radius - off * off, 0.0));
  high = (center.xy + section) / view.near_depth;
  low = (center.xy - section) / view.near_depth;
  for (int k = 0; k < 2; ++k) {
    if (tangent[k] * high_z[k] > beyond[k]) high[k] = max(high[k], (tangent[k] * center[k] + center.z * radius) / high_z[k]);
    if (tangent[k] * low_z[k] > beyond[k]) low[k] = min(low[k], (tangent[k] * center[k] - center.z * radius) / low_z[k]);
  }
}

// Screen-space bounds of a sphere, in pixels.
vec4 sphereExtent(vec3 center, float radius) {
  vec2 low = center.xy - radius, high = center.xy + radius;
  if (view.perspective > 0.0 && center.z - radius <= view.near_depth) {
    cutExtent(center, radius, low, high);
  } else if (view.perspective > 0.0) {
    const float square = (center.z - radius) * (center.z + radius);
    const vec2 spread = radius * sqrt(center.xy * center.xy + square);
    low = (center.xy * center.z - spread) / square;
    high = (center.xy * center.z + spread) / square;
  }
  const vec2 a = pixelOfAxis(low), b = pixelOfAxis(high);
  return vec4(min(a, b), max(a, b));
}

// Whether a part of the sphere is behind the near plane and inside the picture with this margin (pixels).
bool shownWithin(vec3 center, float radius, float margin) {
  if (!(center.z + radius > nearestDrawn())) return false;
  const vec4 extent = sphereExtent(center, radius);
  return all(greaterThanEqual(extent.zw, vec2(-margin))) && all(lessThanEqual(extent.xy, pictureSize() + margin));
}
bool shown(vec3 center, float radius) { return shownWithin(center, radius, float(view.margin * view.step)); }

// Samples lie at the centers of squares of view.step pixels; the first ones are in the margin.
uvec2 sampleGrid() { return (uvec2(view.width, view.height) + view.step - 1u) / view.step + 2u * view.margin; }
vec2 samplePixel(ivec2 at) { return (vec2(at - int(view.margin)) + 0.5) * float(view.step); }
// Position of a pixel on the sample grid; whole numbers are samples.
vec2 sampleOf(vec2 pixel) { return pixel / float(view.step) - 0.5 + float(view.margin); }
// The sample at or before a position of a pixel's center. Positions are whole or at least 1/32 from it, up to the rounding of sampleOf(),
// which may fall on either side.
ivec2 sampleBefore(vec2 at) { return ivec2(floor(at + 1.0 / 64.0)); }
// First and last sample whose center a sphere may cover, both included; empty if last < first.
ivec4 sampleRect(vec3 center, float radius) {
  const vec4 pixels = clamp(sphereExtent(center, radius), vec4(-1e6), vec4(1e6));
  const vec4 extent = vec4(sampleOf(pixels.xy), sampleOf(pixels.zw));
  return ivec4(max(ivec2(ceil(extent.xy)), ivec2(0)), min(ivec2(floor(extent.zw)), ivec2(sampleGrid()) - 1));
}

// Where particles are smaller than samples, spheres and lengths are those of a sample: distant fluid is coarser.
float hardRadius(float z) { return max(view.radius, 0.71 * metersAPixel(z) * float(view.step)); }
float spacingAt(float z) { return max(view.spacing, 1.2 * metersAPixel(z) * float(view.step)); }

// The screen grid: cells of kCellSamples samples a side; positions outside the picture map to the nearest cell.
uvec2 cellGrid() { return (sampleGrid() + kCellSamples - 1u) / kCellSamples; }
ivec2 cellOf(vec2 pixel) {
  return clamp(ivec2(floor((sampleOf(pixel) + 0.5) / float(kCellSamples))), ivec2(0), ivec2(cellGrid()) - 1);
}

// Conversion between view depth and the target's depth.
float targetDepth(float z) { return view.depth_map[0] + view.depth_map[1] * (view.perspective > 0.0 ? 1.0 / z : z); }
float depthOfTarget(float stored) {
  const float part = (stored - view.depth_map[0]) / view.depth_map[1];
  return view.perspective > 0.0 ? (part > 0.0 ? 1.0 / part : noDepth()) : part;
}

// From view space to clip space.
vec4 clipPoint(vec3 v) {
  const float w = view.perspective > 0.0 ? v.z : 1.0;
  const float depth = view.perspective > 0.0 ? view.depth_map[0] * v.z + view.depth_map[1] : targetDepth(v.z);
  return vec4(v.xy / vec2(view.scale[0], view.scale[1]) + w * vec2(view.shift[0], view.shift[1]), depth, w);
}

// Unit vectors in 28 bits: octahedral, 14 bits a coordinate (Cigolle et al. 2014). The other four bits hold a pixel's coverage.
uint packNormal(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  const ivec2 q = ivec2(round(p * 8191.0)) & 0x3FFF;
  return uint(q.x | q.y << 14);
}
vec3 unpackNormal(uint packed) {
  const ivec2 q = ivec2(bitfieldExtract(int(packed), 0, 14), bitfieldExtract(int(packed), 14, 14));
  const vec2 p = vec2(q) / 8191.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  const float fold = max(-n.z, 0.0);
  n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
  return normalize(n);
}

// A pixel of the surface: depth, normal and coverage. At a coverage below 0.5 the depth's sign is set, which reads as no fluid
// everywhere but in shading.
uvec2 packPixel(float z, vec3 normal, float coverage) {
  if (coverage <= 0.0 || !(z < noDepth())) return uvec2(kNoDepthBits, 0u);
  z = max(z, nearestDrawn());
  return uvec2(floatBitsToUint(coverage < 0.5 ? -z : z), packNormal(normal) | uint(coverage * 15.0 + 0.5) << 28);
}
float pixelDepth(uvec2 pixel) { return abs(uintBitsToFloat(pixel.x)); }
float pixelCoverage(uvec2 pixel) { return float(pixel.y >> 28) / 15.0; }
// A sample where the near plane cuts the fluid: in the plane, facing the eye.
uvec2 cutSample(vec2 axis) { return uvec2(floatBitsToUint(nearestDrawn()), packNormal(-normalize(rayAlong(axis)))); }
