#version 460
// The state of each bin: near the surface within a bin of a surface particle, else inside with particles in one of the bins around.
// Lists the former, and sets the field of the latter.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kMeshGroup) in;
READ_UINT(0, start)
READ_UINT(1, neighbors)
READ_UINT(2, surface)
layout(std430, set = 0, binding = 3) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 4) writeonly buffer States { uint states[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Field { float field[]; };  // 1 before
layout(std430, set = 0, binding = 6) writeonly buffer NearBins { uint near_bins[]; };  // bins near the surface, in any order
layout(std430, set = 0, binding = 7) writeonly buffer BinLists { uvec2 bin_lists[]; };

void main() {
  const uint i = flatInvocation(), block = i / kMeshBlockBins;
  if (block >= counts[kMeshBlocksNeeded]) return;
  const ivec3 bin = ivec3(binOf(i % kMeshBlockBins));
  uint state = kMeshOutside;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const ivec3 at = bin + ivec3(x, y, z);
        const uint other = neighborsAt(neighborSlot(block, at >> 2));
        if (other == kMeshNone) continue;
        const uint around = other * kMeshBlockBins + binIn(uvec3(at & 3));
        if (surfaceAt(around) != 0u)
          state = kMeshNear;
        else if (state == kMeshOutside && startAt(around + 1u) > startAt(around))
          state = kMeshInside;
      }
  states[i] = state;
  bin_lists[i] = uvec2(0u, kMeshNone);
  if (state == kMeshNear)
    near_bins[atomicAdd(counts[kMeshNearBins], 1u)] = i;
  else if (state == kMeshInside)
    for (uint c = 0u; c < kBinCorners; ++c) field[i * kBinCorners + c] = -1.0;
}
