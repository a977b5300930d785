#version 460
// Whether cells of a bin may have corners on both sides: unless the bins of all of their corners are outside, or all are inside.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Neighbors { uint neighbors[]; };
layout(std430, set = 0, binding = 1) readonly buffer States { uint states[]; };
layout(std430, set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Mixed { uint mixed[]; };

void main() {
  const uint i = flatInvocation(), block = i / kMeshBlockBins;
  if (block >= counts[kMeshBlocksNeeded]) return;
  const ivec3 bin = ivec3(binOf(i % kMeshBlockBins));
  uint all = 7u;
  for (int c = 0; c < 8; ++c) {
    const ivec3 at = bin + ivec3(c & 1, c >> 1 & 1, c >> 2);
    const uint other = neighbors[neighborSlot(block, at >> 2)];
    all &= 1u << (other == kMeshNone ? kMeshOutside : states[other * kMeshBlockBins + binIn(uvec3(at & 3))]);
  }
  mixed[i] = all == 1u << kMeshOutside || all == 1u << kMeshInside ? 0u : 1u;
}
