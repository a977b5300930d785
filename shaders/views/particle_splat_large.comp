#version 460
// Depth of the large survivors: a workgroup has a tile of pixels and a chunk of spheres. Two runs, as in particle_splat.comp.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#include "views/particle_view.glsl"
#include "shared/atomic_load.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 3) buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) buffer Winner { uint winner[]; };

shared vec4 spheres[256];
shared uint indices[256];
shared uint sphere_count;
shared uint tile_depth;  // largest depth in the tile so far; spheres behind it are hidden

void main() {
  const uint columns = (view.width + kPixelTile - 1u) / kPixelTile, rows = (view.height + kPixelTile - 1u) / kPixelTile;
  const uint group = groupIndex();
  const uint tile_index = group % (columns * rows), first = group / (columns * rows) * kLargeChunk;
  const uint last = min(first + kLargeChunk, counters[kLargeCount]);
  const uvec2 tile = uvec2(tile_index % columns, tile_index / columns) * kPixelTile;
  const uvec2 pixel = tile + gl_LocalInvocationID.xy;
  const bool inside = pixel.x < view.width && pixel.y < view.height;
  const uint at = inside ? pixel.y * view.width + pixel.x : 0u;
  const uint before = ATOMIC_LOAD(depth[at]);
  uint best = before, owner = kNobody;
  for (uint base = first; base < last; base += 256u) {
    barrier();
    if (gl_LocalInvocationIndex == 0u) sphere_count = tile_depth = 0u;
    barrier();
    if (inside) atomicMax(tile_depth, best);
    barrier();
    const uint k = base + gl_LocalInvocationIndex;
    if (k < last) {
      const uint i = survivors[view.count - 1u - k];
      const vec3 center = viewPoint(particlePoint(position[i].xyz));
      const float radius = drawnRadius(center.z);
      const ivec4 rect = sphereRect(center, radius);
      const ivec2 low = ivec2(tile), high = low + int(kPixelTile) - 1;
      const bool shown = floatBitsToUint(max(center.z - radius, 0.0)) <= tile_depth;
      if (shown && rect.x <= high.x && rect.z >= low.x && rect.y <= high.y && rect.w >= low.y) {
        const uint slot = atomicAdd(sphere_count, 1u);
        spheres[slot] = vec4(center, radius);
        indices[slot] = i;
      }
    }
    barrier();
    for (uint n = 0u; n < sphere_count; ++n) {
      const float t = pixelDepth(spheres[n].xyz, spheres[n].w, ivec2(pixel));
      if (t > 0.0) {
        best = min(best, floatBitsToUint(t));
        if (floatBitsToUint(t) == before) owner = min(owner, indices[n]);
      }
    }
  }
  if (!inside) return;
  if (view.winners == 0u) {
    if (best < before) atomicMin(depth[at], best);
  } else {
    if (owner != kNobody) atomicMin(winner[at], owner);
  }
}
