#version 460
// Each particle marks the occlusion cells that its sphere covers completely with the depth of its center, which hides all behind it.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#include "render/surface.glsl"
#include "shared/atomic_load.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Occluders { uint occluders[]; };
layout(std430, set = 0, binding = 2) readonly buffer ParticleCount { uint particle_count; };

void main() {
  const uint i = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (i >= min(view.count, particle_count) || !drawable(position[i].xyz)) return;
  const vec3 center = viewPoint(position[i].xyz);
  const float radius = hardRadius(center.z);
  if (!(center.z > view.near_depth) || !shown(center, radius)) return;
  // A square inside the sphere's silhouette.
  const vec2 middle = sampleOf(pixelOf(center)) + 0.5;
  const float side = 0.7 * radius / metersAPixel(center.z) / float(view.step);
  const float cell = float(kOccluderSamples);
  const ivec2 cells = ivec2((sampleGrid() + kOccluderSamples - 1u) / kOccluderSamples);
  const ivec2 first = max(ivec2(ceil(clamp((middle - side) / cell, vec2(-1e6), vec2(1e6)))), ivec2(0));
  const ivec2 last = min(ivec2(floor(clamp((middle + side) / cell, vec2(-1e6), vec2(1e6)))) - 1, cells - 1);
  const ivec2 limit = min(last, first + int(kMaxCells) - 1);
  const uint bits = floatBitsToUint(center.z);
  for (int y = first.y; y <= limit.y; ++y)
    for (int x = first.x; x <= limit.x; ++x) {
      const uint at = uint(y * cells.x + x);
      if (bits < ATOMIC_LOAD(occluders[at])) atomicMin(occluders[at], bits);
    }
}
