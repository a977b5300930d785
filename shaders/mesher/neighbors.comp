#version 460
// The blocks around each block.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Blocks { uint blocks[]; };
layout(std430, set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Neighbors { uint neighbors[]; };
#include "mesher/search.glsl"

void main() {
  const uint i = flatInvocation(), block = i / kMeshNeighbors, to = i % kMeshNeighbors;
  if (block >= counts[kMeshBlocksNeeded]) return;
  neighbors[i] = findBlock(keyOf(blockOf(blocks[block]) + ivec3(to / 9u, to / 3u % 3u, to % 3u) - 1));
}
