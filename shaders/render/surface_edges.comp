#version 460
// The listed pixels, whose samples are not on one surface, are evaluated one by one. With FILTERED, for samples of a depth filter,
// only the coverage is evaluated and the surface is a sample's.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
#include "render/surface_arrays.glsl"
READ_UINT(2, depth)
READ_UINT2(3, samples)
layout(std430, set = 0, binding = 4) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 5) readonly buffer Edges { uint edges[]; };
layout(std430, set = 0, binding = 6) writeonly buffer Surface { uvec2 surface[]; };  // packPixel()
#ifdef FILTERED
#include "render/surface_coverage.glsl"
#include "render/surface_corners.glsl"
#else
#define PLANES 7
#include "render/surface_blend.glsl"
#endif
#include "render/surface_interior.glsl"
#include "render/surface_depth_range.glsl"

struct EdgePixel {
  float z, coverage;
  vec3 normal;
};

#ifdef FILTERED
// The plane of the nearest of the four samples on the surface that covers this pixel.
EdgePixel evaluate(vec2 middle, ivec2 own, float nearest, float farthest) {
  const vec2 axis = axisOf(middle);
  EdgePixel pixel_surface = EdgePixel(noDepth(), coverageFromCenters(axis, nearest), vec3(0.0, 0.0, -1.0));
  float hard = nearest;
  if (pixel_surface.coverage < 1.0 && farthest > nearest + 0.5 * view.spacing) {
    const float behind = coverageFromCenters(axis, farthest);
    if (pixel_surface.coverage < 0.5) hard = farthest;
    pixel_surface.coverage = max(pixel_surface.coverage, behind) >= 0.5 ? 1.0 : behind;
  }
  if (pixel_surface.coverage < 1.0) pixel_surface.coverage = max(pixel_surface.coverage, interiorCoverage(middle));
  if (pixel_surface.coverage <= 0.0) return pixel_surface;
  const Corners c = cornersOf(middle);
  float best = 1e30;
  for (int k = 0; k < 4; ++k) {
    const vec2 off = c.part - vec2(k & 1, k >> 1);
    const float badness = c.depths[k] < noDepth() ? dot(off, off) + 4.0 * abs(c.depths[k] - hard) / view.spacing : 1e30;
    if (badness >= best) continue;
    best = badness;
    pixel_surface.normal = c.normals[k];
    const float slope = dot(rayAlong(axis), pixel_surface.normal), height = dot(c.points[k] - rayFrom(axis), pixel_surface.normal);
    pixel_surface.z = slope < -0.05 * length(rayAlong(axis))
                 ? clamp(height / slope, c.depths[k] - view.spacing, c.depths[k] + view.spacing)
                 : c.depths[k];
  }
  return pixel_surface;
}
#else
EdgePixel evaluate(vec2 middle, ivec2 own, float nearest, float farthest) {
  const vec2 axis = axisOf(middle);
  Blend blend = blendAt(axis, nearest);
  float coverage = blend.coverage;
  // At an edge in front of other fluid, coverage counts both.
  if (coverage < 1.0 && farthest > nearest + 0.5 * view.spacing) {
    const Blend behind = blendAt(axis, farthest);
    if (coverage < 0.5) blend = behind;
    coverage = max(coverage, behind.coverage) >= 0.5 ? 1.0 : behind.coverage;
  }
  const float interior = coverage < 1.0 ? interiorCoverage(middle) : 0.0;
  if (coverage < 0.5 && interior > coverage) {
    const float hard = uintBitsToFloat(depthAt(uint(own.y) * sampleGrid().x + uint(own.x)));
    blend = blendAt(axis, hard < noDepth() ? hard : nearest);
  }
  coverage = max(coverage, interior);
  return EdgePixel(blend.depth, coverage, blend.normal);
}
#endif

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (k >= counters[kEdgeCount]) return;
  const uvec2 pixel = uvec2(edges[k] % view.width, edges[k] / view.width);
  const ivec2 own = sampleOfPixel(pixel);
  float nearest = noDepth(), farthest = 0.0;
  depthRange(own, nearest, farthest);
  const EdgePixel pixel_surface = evaluate(vec2(pixel) + 0.5, own, nearest, farthest);
  surface[edges[k]] = packPixel(pixel_surface.z, pixel_surface.normal, pixel_surface.coverage);
  if (bound_hit) atomicAdd(counters[kBoundHits], 1u);
}
