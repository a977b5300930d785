#version 460
// 1 where a sorted key differs from the one before; 0 for kMeshNone and behind the last one.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Sorted { uint sorted[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Ranks { uint ranks[]; };

void main() {
  const uint i = flatInvocation();
  if (i > mesh.capacity) return;
  const uint key = i < mesh.capacity ? sorted[i] : kMeshNone;
  ranks[i] = key != kMeshNone && (i == 0u || sorted[i - 1u] != key) ? 1u : 0u;
}
