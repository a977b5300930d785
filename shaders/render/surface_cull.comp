#version 460
// Lists the particles that are not occluded, in any order.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Occluders { uint occluders[]; };
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 4) readonly buffer ParticleCount { uint particle_count; };

bool hidden(vec3 center, float radius) {
  const float cell = float(kOccluderSamples);
  const ivec2 cells = ivec2((sampleGrid() + kOccluderSamples - 1u) / kOccluderSamples);
  const vec4 pixels = clamp(sphereExtent(center, radius), vec4(-1e6), vec4(1e6));
  const vec4 extent = (vec4(sampleOf(pixels.xy), sampleOf(pixels.zw)) + 0.5) / cell;
  const ivec2 first = clamp(ivec2(floor(extent.xy)), ivec2(0), cells - 1), last = clamp(ivec2(floor(extent.zw)), ivec2(0), cells - 1);
  if (any(greaterThan(last - first, ivec2(int(kMaxCells))))) return false;
  const uint bits = floatBitsToUint(max(center.z - radius, view.near_depth));
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (occluders[uint(y * cells.x + x)] >= bits) return false;
  return true;
}

void main() {
  const uint i = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (i >= min(view.count, particle_count) || !drawable(position[i].xyz)) return;
  const vec3 center = viewPoint(position[i].xyz);
  const float radius = hardRadius(center.z);
  if (!shown(center, radius) || hidden(center, radius)) return;
  survivors[atomicAdd(counters[kSurvivorCount], 1u)] = i;
}
