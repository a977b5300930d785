#version 460
// Hard depth: the nearest sphere of every sample.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 3) buffer Depth { uint depth[]; };

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (k >= counters[kSurvivorCount]) return;
  const vec3 centre = viewPoint(position[survivors[k]].xyz);
  const float radius = hardRadius(centre.z);
  bool cut;
  const ivec4 rect = sampleRect(centre, radius, cut);
  if (cut) atomicAdd(counters[kBoundHits], 1u);
  const uint columns = sampleGrid().x;
  for (int y = rect.y; y <= rect.w; ++y)
    for (int x = rect.x; x <= rect.z; ++x) {
      const float t = sphereDepth(centre, radius, axisOf(samplePixel(ivec2(x, y))));
      if (t < 0.0) continue;
      const uint at = uint(y) * columns + uint(x);
      const uint bits = floatBitsToUint(t);
      if (bits < depth[at]) atomicMin(depth[at], bits);
    }
}
