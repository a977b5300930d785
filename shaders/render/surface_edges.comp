#version 460
// The listed pixels, whose samples do not lie on one surface: each has a look of its own. With
// FILTERED, where the samples come from a depth filter, that look tells how much of the pixel is
// fluid, and the surface is a sample's.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
#include "render/surface_arrays.glsl"
layout(std430, set = 0, binding = 3) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) readonly buffer Samples { uvec2 samples[]; };
layout(std430, set = 0, binding = 5) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 6) readonly buffer Edges { uint edges[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Surface { uvec2 surface[]; };  // packPixel()
#ifdef FILTERED
#include "render/surface_cover.glsl"
#include "render/surface_corners.glsl"
#else
#include "render/surface_blend.glsl"
#endif
#include "render/surface_solid.glsl"
#include "render/surface_around.glsl"

struct Look {
  float z, coverage;
  vec3 normal;
};

#ifdef FILTERED
// On the plane of the nearest of the four samples, of the surface that covers this pixel.
Look lookAt(vec2 middle, ivec2 own, float nearest, float farthest) {
  const vec2 axis = axisOf(middle);
  Look look = Look(infinity(), coverOf(axis, nearest), vec3(0.0, 0.0, -1.0));
  float hard = nearest;
  if (look.coverage < 1.0 && farthest > nearest + 0.5 * view.spacing) {
    const float behind = coverOf(axis, farthest);
    if (look.coverage < 0.5) hard = farthest;
    look.coverage = max(look.coverage, behind) >= 0.5 ? 1.0 : behind;
  }
  if (look.coverage < 1.0) look.coverage = max(look.coverage, solidCoverage(middle));
  if (look.coverage <= 0.0) return look;
  const Corners c = cornersOf(middle);
  float best = 1e30;
  for (int k = 0; k < 4; ++k) {
    const vec2 off = c.part - vec2(k & 1, k >> 1);
    const float badness = c.depths[k] < infinity() ? dot(off, off) + 4.0 * abs(c.depths[k] - hard) / view.spacing : 1e30;
    if (badness >= best) continue;
    best = badness;
    look.normal = c.normals[k];
    const float slope = dot(rayAlong(axis), look.normal), height = dot(c.points[k] - rayFrom(axis), look.normal);
    look.z = slope < -0.05 * length(rayAlong(axis))
                 ? clamp(height / slope, c.depths[k] - view.spacing, c.depths[k] + view.spacing)
                 : c.depths[k];
  }
  return look;
}
#else
Look lookAt(vec2 middle, ivec2 own, float nearest, float farthest) {
  const vec2 axis = axisOf(middle);
  Blend blend = blendAt(axis, nearest);
  float coverage = blend.coverage;
  // an edge before other fluid is one without a pixel of what is behind both
  if (coverage < 1.0 && farthest > nearest + 0.5 * view.spacing) {
    const Blend behind = blendAt(axis, farthest);
    if (coverage < 0.5) blend = behind;
    coverage = max(coverage, behind.coverage) >= 0.5 ? 1.0 : behind.coverage;
  }
  const float solid = coverage < 1.0 ? solidCoverage(middle) : 0.0;
  if (coverage < 0.5 && solid > coverage) {
    const float hard = uintBitsToFloat(depth[uint(own.y) * sampleGrid().x + uint(own.x)]);
    blend = blendAt(axis, hard < infinity() ? hard : nearest);
  }
  coverage = max(coverage, solid);
  return Look(blend.depth, coverage, blend.normal);
}
#endif

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (k >= counters[kEdgeCount]) return;
  const uvec2 pixel = uvec2(edges[k] % view.width, edges[k] / view.width);
  const ivec2 own = sampleOfPixel(pixel);
  float nearest = infinity(), farthest = 0.0;
  depthsAround(own, nearest, farthest);
  const Look look = lookAt(vec2(pixel) + 0.5, own, nearest, farthest);
  surface[edges[k]] = packPixel(look.z, look.normal, look.coverage);
  if (bound_hit) atomicAdd(counters[kBoundHits], 1u);
}
