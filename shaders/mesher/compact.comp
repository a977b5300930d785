#version 460
// The distinct keys in order, and their number.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Sorted { uint sorted[]; };
layout(std430, set = 0, binding = 1) readonly buffer Ranks { uint ranks[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Listed { uint listed[]; };
layout(std430, set = 0, binding = 3) buffer Counts { uint counts[]; };

void main() {
  const uint i = flatInvocation();
  if (i > mesh.capacity) return;
  const uint rank = ranks[i];
  if (i == mesh.capacity)
    counts[mesh.list] = rank;
  else if (ranks[i + 1u] != rank && rank < mesh.max_blocks)
    listed[rank] = sorted[i];
}
