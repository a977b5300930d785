#version 460
// The fluid's first and last depth from the sun: of the spheres of its particles.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#include "render/caustics.glsl"
#include "shared/active.glsl"
#include "shared/atomic_load.glsl"

layout(local_size_x = kCausticGroup) in;
layout(std430, set = 0, binding = 1) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 2) readonly buffer ParticleCount { uint particle_count; };
layout(std430, set = 0, binding = 3) buffer First { uint first[]; };
layout(std430, set = 0, binding = 4) buffer Last { uint last[]; };

const float kRadius = 0.9;  // spacings: spheres that leave no gap
const int kReach = 4;       // texels at most on each side

void main() {
  const uint i = invocation();
  if (i >= min(sun.particles, particle_count) || !drawable(position[i].xyz)) return;
  const vec4 p = vec4(position[i].xyz, 1.0);
  const vec3 center = vec3(dot(sun.light[0], p), dot(sun.light[1], p), dot(sun.light[2], p));
  const vec2 at = center.xy / sun.texel;
  const float radius = max(kRadius * sun.spacing, 0.75 * sun.texel);
  if (any(lessThan(at, vec2(-8.0))) || any(greaterThan(at, vec2(sun.width, sun.height) + 8.0))) return;
  const float reach = min(radius / sun.texel, float(kReach));
  const ivec2 low = max(ivec2(ceil(at - reach)), ivec2(0)), high = min(ivec2(floor(at + reach)), ivec2(sun.width, sun.height) - 1);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const vec2 off = vec2(x, y) * sun.texel - center.xy;
      const float inside = radius * radius - dot(off, off);
      if (inside <= 0.0) continue;
      const uint texel = texelIndex(ivec2(x, y));
      const uvec3 ends = ordered(vec3(center.z - sqrt(inside), center.z + sqrt(inside), 0.0));
      if (ends.x < ATOMIC_LOAD(first[texel])) atomicMin(first[texel], ends.x);
      if (ends.y > ATOMIC_LOAD(last[texel])) atomicMax(last[texel], ends.y);
    }
}
