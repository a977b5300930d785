#version 460
// Keys of the blocks that particles reach, 27 for each block with particles.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Occupied { uint occupied[]; };
layout(std430, set = 0, binding = 1) readonly buffer Reached { uint reached[]; };
layout(std430, set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Keys { uint keys[]; };

void main() {
  const uint i = flatInvocation();
  if (i >= mesh.max_blocks * kMeshNeighbors) return;
  const uint block = i / kMeshNeighbors, to = i % kMeshNeighbors;
  const bool used = block < min(counts[kMeshOccupied], mesh.max_blocks) && (reached[block] >> to & 1u) != 0u;
  keys[i] = used ? keyOf(blockOf(occupied[block]) + ivec3(to / 9u, to / 3u % 3u, to % 3u) - 1) : kMeshNone;
}
