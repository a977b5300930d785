#version 460
// Each particle marks the light map, and the occlusion cells that it covers completely, with its largest depth over the cells.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#include "views/particle_view.glsl"
#include "shared/atomic_load.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 2) buffer Occluders { uint occluders[]; };
layout(std430, set = 0, binding = 3) buffer LightMap { uint light_map[]; };
layout(std430, set = 0, binding = 4) readonly buffer ParticleCount { uint particle_count; };
#include "views/particle_light.glsl"

void markLight(vec3 world) {
  const vec2 at = lightTexel(world);
  const float reach = min(view.radius / scene.light_texel.x, 1.0) + 0.25;
  const vec2 limit = vec2(scene.counts.yz);
  const ivec2 first = ivec2(ceil(clamp(at - reach, vec2(0.0), limit))), last = ivec2(floor(clamp(at + reach, vec2(-1.0), limit - 1.0)));
  const uint bits = floatBitsToUint(max(lightDepth(world), 0.0));
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      const uint texel = uint(y) * scene.counts.y + uint(x);
      if (bits < ATOMIC_LOAD(light_map[texel])) atomicMin(light_map[texel], bits);
    }
  }
}

void markCells(vec3 center, float radius) {
  const vec2 middle = center.xy / center.z;
  const float side = 0.66 * radius / center.z;
  // The screen region where a sphere is nearer than a depth is convex, so its depth over a rectangle is largest at a corner.
  const vec4 corners = vec4(sphereDepth(center, radius, middle + vec2(-side, -side)),
                            sphereDepth(center, radius, middle + vec2(side, -side)),
                            sphereDepth(center, radius, middle + vec2(-side, side)),
                            sphereDepth(center, radius, middle + vec2(side, side)));
  if (min(min(corners.x, corners.y), min(corners.z, corners.w)) < 0.0) return;
  const uint bits = floatBitsToUint(max(max(corners.x, corners.y), max(corners.z, corners.w)));
  const vec2 limit = vec2(float(view.width), float(view.height));
  const vec2 low = clamp(pixelOf(middle + vec2(-side, side)), vec2(0.0), limit);
  const vec2 high = clamp(pixelOf(middle + vec2(side, -side)), vec2(0.0), limit);
  const float cell = float(view.cell);
  const ivec2 cells = ivec2((uvec2(view.width, view.height) + view.cell - 1u) / view.cell);
  ivec2 first = ivec2(ceil((low - 0.5) / cell)), last = min(ivec2(floor((high + 0.5) / cell)) - 1, cells - 1);
  const ivec2 center_cell = (first + last) / 2;
  first = max(max(first, center_cell - int(kOccluderCells) / 2), ivec2(0));
  last = min(last, center_cell + int(kOccluderCells) / 2);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      const uint index = uint(y * cells.x + x);
      if (bits < ATOMIC_LOAD(occluders[index])) atomicMin(occluders[index], bits);
    }
  }
}

void main() {
  const uint i = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  if (i >= min(view.count, particle_count)) return;
  const vec3 world = particlePoint(position[i].xyz);
  if (!drawable(world)) return;
  markLight(world);
  const vec3 center = viewPoint(world);
  const float radius = drawnRadius(center.z);
  if (outsideImage(center, radius) || center.z - radius <= view.near_depth) return;
  markCells(center, radius);
}
