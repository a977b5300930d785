#version 460
// The bin of each particle; the last key for particles that are in none.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Keys { uint keys[]; };
layout(std430, set = 0, binding = 2) readonly buffer Blocks { uint blocks[]; };
layout(std430, set = 0, binding = 3) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 4) writeonly buffer BinKeys { uint bin_keys[]; };
#include "mesher/search.glsl"

void main() {
  const uint i = flatInvocation();
  if (i >= mesh.capacity) return;
  const uint block = keys[i] == kMeshNone ? kMeshNone : findBlock(keys[i]);
  uint key = mesh.max_blocks * kMeshBlockBins;
  if (block != kMeshNone) key = block * kMeshBlockBins + binIn(uvec3(binAt(position[i].xyz / mesh.spacing) & 3));
  bin_keys[i] = key;
}
