#version 460
// The surface of every pixel of the tiles with fluid: between four samples that lie on one surface what they say, elsewhere its own look.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceTile, local_size_y = kSurfaceTile) in;
#include "render/surface_arrays.glsl"
layout(std430, set = 0, binding = 3) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) readonly buffer Samples { uvec2 samples[]; };
layout(std430, set = 0, binding = 5) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 6) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Surface { uvec2 surface[]; };  // packPixel()
#ifdef FILTERED
#include "render/surface_cover.glsl"
#else
#include "render/surface_blend.glsl"
#endif
#include "render/surface_solid.glsl"

const float kAgree = 0.35;  // spacings that a sample may lie off the plane through another

void main() {
  if (groupIndex() >= counters[kSurfaceTileCount]) return;
  const uint tile = tiles[groupIndex()];
  const uint columns = (view.width + kSurfaceTile - 1u) / kSurfaceTile;
  const uvec2 pixel = uvec2(tile % columns, tile / columns) * kSurfaceTile + gl_LocalInvocationID.xy;
  if (pixel.x >= view.width || pixel.y >= view.height) return;
  const vec2 middle = vec2(pixel) + 0.5, axis = axisOf(middle);
  const ivec2 grid = ivec2(sampleGrid());
  const vec2 at = sampleOf(middle);
  const ivec2 base = ivec2(floor(at));
  const vec2 part = at - vec2(base);

  // The four samples around, each with its plane: how far off the plane of the first one do the others lie?
  float depths[4];
  vec3 normals[4];
  bool agree = true;
  float nearest = infinity(), farthest = 0.0;
  for (int k = 0; k < 4; ++k) {
    const ivec2 s = clamp(base + ivec2(k & 1, k >> 1), ivec2(0), grid - 1);
    const uvec2 stored = samples[uint(s.y * grid.x + s.x)];
    depths[k] = uintBitsToFloat(stored.x);
    normals[k] = unpackNormal(stored.y);
    agree = agree && depths[k] < infinity();
  }
  vec3 points[4];
  for (int k = 0; k < 4; ++k) {
    const vec2 sample_axis = axisOf(samplePixel(clamp(base + ivec2(k & 1, k >> 1), ivec2(0), grid - 1)));
    points[k] = rayFrom(sample_axis) + depths[k] * rayAlong(sample_axis);
  }
  for (int k = 1; k < 4 && agree; ++k) {
    const vec3 d = points[k] - points[0];
    agree = abs(dot(d, normals[0])) < kAgree * view.spacing && abs(dot(d, normals[k])) < kAgree * view.spacing;
  }

  float z = infinity(), coverage = 0.0;
  vec3 normal = vec3(0.0, 0.0, -1.0);
  if (agree) {
    coverage = 1.0;
    const vec4 weight = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
    // In perspective it is the inverse of depth that is linear across a plane.
    const vec4 each = vec4(depths[0], depths[1], depths[2], depths[3]);
    z = view.perspective > 0.0 ? 1.0 / dot(weight, 1.0 / each) : dot(weight, each);
    normal = normalize(weight.x * normals[0] + weight.y * normals[1] + weight.z * normals[2] + weight.w * normals[3]);
  } else {
    const ivec2 own = ivec2(pixel / view.step + view.margin);
    for (int y = max(own.y - 1, 0); y <= min(own.y + 1, grid.y - 1); ++y)
      for (int x = max(own.x - 1, 0); x <= min(own.x + 1, grid.x - 1); ++x) {
        const float hard = uintBitsToFloat(depth[uint(y * grid.x + x)]);
        nearest = min(nearest, hard);
        if (hard < infinity()) farthest = max(farthest, hard);
      }
#ifdef FILTERED
    // The nearest of the four samples, of the surface that covers this pixel.
    float hard = nearest;
    if (nearest < infinity()) coverage = coverOf(axis, nearest);
    if (coverage < 1.0 && farthest > nearest + 0.5 * view.spacing) {
      const float behind = coverOf(axis, farthest);
      if (coverage < 0.5) hard = farthest;
      coverage = max(coverage, behind) >= 0.5 ? 1.0 : behind;
    }
    if (coverage < 1.0 && solidAround(own)) coverage = 1.0;
    if (coverage > 0.0) {
      float best = 1e30;
      for (int k = 0; k < 4; ++k) {
        const vec2 off = part - vec2(k & 1, k >> 1);
        const float badness = depths[k] < infinity() ? dot(off, off) + 4.0 * abs(depths[k] - hard) / view.spacing : 1e30;
        if (badness >= best) continue;
        best = badness;
        normal = normals[k];
        // On that sample's plane.
        const float slope = dot(rayAlong(axis), normal), height = dot(points[k] - rayFrom(axis), normal);
        z = slope < -0.05 * length(rayAlong(axis)) ? clamp(height / slope, depths[k] - view.spacing, depths[k] + view.spacing) : depths[k];
      }
    }
#else
    if (nearest < infinity()) {
      Blend blend = blendAt(axis, nearest);
      coverage = blend.coverage;
      if (coverage < 1.0 && farthest > nearest + 0.5 * view.spacing) {  // an edge before other fluid is one without a pixel of what is behind both
        const Blend behind = blendAt(axis, farthest);
        if (coverage < 0.5) blend = behind;
        coverage = max(coverage, behind.coverage) >= 0.5 ? 1.0 : behind.coverage;
      }
      if (coverage < 0.5 && solidAround(own)) {
        blend = blendAt(axis, uintBitsToFloat(depth[uint(own.y * grid.x + own.x)]));
        coverage = 1.0;
      }
      z = blend.depth;
      normal = blend.normal;
    }
#endif
  }
  surface[pixel.y * view.width + pixel.x] = packPixel(z, normal, coverage);
  if (bound_hit) atomicAdd(counters[kBoundHits], 1u);
}
