#version 460
// Positions in spacings, in the order of the bins, as bits, with the bin in w.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Order { uint order[]; };
layout(std430, set = 0, binding = 2) readonly buffer Start { uint start[]; };
layout(std430, set = 0, binding = 3) readonly buffer BinKeys { uint bin_keys[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Places { uvec4 places[]; };

void main() {
  const uint slot = flatInvocation();
  if (slot >= start[mesh.max_blocks * kMeshBlockBins]) return;
  const uint i = order[slot];
  places[slot] = uvec4(floatBitsToUint(position[i].xyz / mesh.spacing), bin_keys[i]);
}
