#version 460
// Depth of the small survivors, one invocation per sphere. The second run finds the smallest index among those at a pixel's depth; both
// runs use one shader, so that they compute exactly the same depths.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#include "views/particle_view.glsl"
#include "shared/atomic_load.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 3) buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) buffer Winner { uint winner[]; };

void main() {
  const uint k = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  if (k >= counters[kSmallCount]) return;
  const uint i = survivors[k];
  const vec3 center = viewPoint(particlePoint(position[i].xyz));
  const float radius = drawnRadius(center.z);
  const ivec4 rect = sphereRect(center, radius);
  const int pixels = (rect.z - rect.x + 1) * (rect.w - rect.y + 1);  // at most kSmallRect squared
  ivec2 pixel = rect.xy;
  for (int n = 0; n < pixels; ++n) {
    const float t = pixelDepth(center, radius, pixel);
    if (t > 0.0) {
      const uint at = uint(pixel.y) * view.width + uint(pixel.x);
      const uint bits = floatBitsToUint(t);
      const uint before = ATOMIC_LOAD(depth[at]);
      if (view.winners == 0u) {
        if (bits < before) atomicMin(depth[at], bits);
      } else {
        if (bits == before) atomicMin(winner[at], i);
      }
    }
    pixel.x += 1;
    if (pixel.x > rect.z) pixel = ivec2(rect.x, pixel.y + 1);
  }
}
