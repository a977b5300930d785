#version 460
// Lists the particles that may be visible: small ones from the front of the buffer, large ones from the back.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Occluders { uint occluders[]; };
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 4) readonly buffer ParticleCount { uint particle_count; };

bool hidden(vec3 center, float radius, ivec4 rect) {
  const uint columns = (view.width + view.cell - 1u) / view.cell;
  const uint bits = floatBitsToUint(center.z - radius);
  const uvec4 cells = uvec4(rect) / view.cell;
  if ((cells.z - cells.x + 1u) * (cells.w - cells.y + 1u) > kHiddenCells) return false;
  for (uint y = cells.y; y <= cells.w; ++y) {
    for (uint x = cells.x; x <= cells.z; ++x) {
      if (occluders[y * columns + x] >= bits) return false;
    }
  }
  return true;
}

void main() {
  const uint i = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  if (i >= min(view.count, particle_count)) return;
  const vec3 world = particlePoint(position[i].xyz);
  if (!drawable(world)) return;
  const vec3 center = viewPoint(world);
  const float radius = drawnRadius(center.z);
  if (outsideImage(center, radius)) return;
  const ivec4 rect = sphereRect(center, radius);
  if (rect.z < rect.x || rect.w < rect.y) return;
  const bool whole = center.z - radius > view.near_depth;  // not cut by the near plane
  if (whole && hidden(center, radius, rect)) return;
  if (whole && max(rect.z - rect.x, rect.w - rect.y) < int(kSmallRect)) {
    survivors[atomicAdd(counters[kSmallCount], 1u)] = i;
  } else {
    survivors[view.count - 1u - atomicAdd(counters[kLargeCount], 1u)] = i;
  }
}
