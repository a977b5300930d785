#version 460
// Which of the blocks around a block its particles reach, as bits of neighborSlot(): with a cell more at the lower side, so that each
// cell with a corner inside the fluid lies in a block.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) readonly buffer Sorted { uint sorted[]; };
layout(std430, set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(std430, set = 0, binding = 3) readonly buffer Ranks { uint ranks[]; };
layout(std430, set = 0, binding = 4) buffer Reached { uint reached[]; };

void main() {
  const uint slot = flatInvocation();
  if (slot >= mesh.capacity || sorted[slot] == kMeshNone) return;
  const uint block = ranks[slot + 1u] - 1u;
  if (block >= mesh.max_blocks) return;
  const vec3 x = position[order[slot]].xyz / mesh.spacing;
  const ivec3 here = blockOf(sorted[slot]);
  const ivec3 low = max((binAt(x - (kMeshReach + mesh.cell)) >> 2) - here, -1), high = min((binAt(x + kMeshReach) >> 2) - here, 1);
  uint bits = 0u;
  for (int a = low.x; a <= high.x; ++a)
    for (int b = low.y; b <= high.y; ++b)
      for (int c = low.z; c <= high.z; ++c) bits |= 1u << neighborSlot(0u, ivec3(a, b, c));
  atomicOr(reached[block], bits);
}
