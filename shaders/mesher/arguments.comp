#version 460
// Dispatch arguments of passes over blocks. Nothing is dispatched where blocks have no room.
// NEAR: of passes over the bins near the surface.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Arguments { uint arguments[]; };

void put(uint at, uint invocations) {
  const uvec3 groups = foldGroups(divideUp(invocations, kMeshGroup));
  arguments[at] = groups.x;
  arguments[at + 1u] = groups.y;
  arguments[at + 2u] = groups.z;
}

void main() {
#ifdef NEAR
  put(kMeshNearGroups, counts[kMeshNearBins]);
  put(kMeshCornerGroups, counts[kMeshNearBins] * kBinCorners);
#else
  // With too many occupied blocks the others are not all known.
  const uint needed = max(counts[kMeshBlocksNeeded], counts[kMeshOccupied]);
  counts[kMeshBlocksNeeded] = needed;
  const uint blocks = needed <= mesh.max_blocks ? needed : 0u;
  put(kMeshNeighborGroups, blocks * kMeshNeighbors);
  put(kMeshBinGroups, blocks * kMeshBlockBins);
  put(kMeshRowGroups, blocks * kBlockRows);
#endif
}
