#version 460
// Thickness of the fluid along each sample's ray: every particle spreads its volume over a disc (BARE: no scene is in the way).
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Thickness { uint thickness[]; };  // in view.unit
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
#ifndef BARE
layout(std430, set = 0, binding = 3) readonly buffer SceneDepth { float scene_depth[]; };  // a pixel, m
#endif

bool behindScene(ivec2 at, float z) {
#ifdef BARE
  return false;
#else
  const uvec2 pixel = min(uvec2(samplePixel(at)), uvec2(view.width, view.height) - 1u);
  return z > scene_depth[pixel.y * view.width + pixel.x];
#endif
}

void add(ivec2 at, float z, float metres) {
  const ivec2 grid = ivec2(sampleGrid());
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, grid)) || behindScene(at, z)) return;
  const uint amount = uint(metres / view.unit + 0.5);
  if (amount > 0u) atomicAdd(thickness[uint(at.y * grid.x + at.x)], amount);
}

void main() {
  const uint i = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (i >= view.count || !drawable(position[i].xyz)) return;
  const vec3 centre = viewPoint(position[i].xyz);
  const float radius = view.radius;
  if (!(centre.z > view.near_depth) || !shownWithin(centre, radius, float(view.step))) return;  // a sample gets its share of what is beside the picture, too
  const float volume = view.spacing * view.spacing * view.spacing;
  const float side = metresAPixel(centre.z) * float(view.step);
  if (radius < 1.5 * side) {  // too small for its disc to be sampled: shared among the four samples around
    const vec2 at = sampleOf(pixelOf(centre));
    const ivec2 base = ivec2(floor(at));
    const vec2 part = at - vec2(base);
    const float all = volume / (side * side);
    add(base, centre.z, all * (1.0 - part.x) * (1.0 - part.y));
    add(base + ivec2(1, 0), centre.z, all * part.x * (1.0 - part.y));
    add(base + ivec2(0, 1), centre.z, all * (1.0 - part.x) * part.y);
    add(base + ivec2(1, 1), centre.z, all * part.x * part.y);
    return;
  }
  // (1 - r^2 / R^2)^2 has the integral pi R^2 / 3 over its disc.
  const float peak = volume * 3.0 / (3.14159265 * radius * radius);
  bool cut;
  const ivec4 rect = sampleRect(centre, radius, cut);
  if (cut) atomicAdd(counters[kBoundHits], 1u);
  for (int y = rect.y; y <= rect.w; ++y)
    for (int x = rect.x; x <= rect.z; ++x) {
      const float inside = 1.0 - raySquare(centre, axisOf(samplePixel(ivec2(x, y)))) / (radius * radius);
      if (inside > 0.0) add(ivec2(x, y), centre.z, peak * inside * inside);
    }
}
