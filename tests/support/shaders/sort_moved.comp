// target[slot] = index before the sort (KeySortDesc::fusedEnds).
#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Keys { uint key[]; };
layout(binding = 1) readonly buffer Start { uint start[]; };
layout(binding = 2) readonly buffer Arrived { uint arrived[]; };
layout(binding = 3) readonly buffer Order { uint order[]; };
layout(binding = 4) writeonly buffer Target { uint target[]; };
layout(push_constant) uniform Push { uint count; };
uint startAt(uint k) { return start[k]; }
uint arrivedAt(uint k) { return arrived[k]; }
#include "sort/place.glsl"
void main() {
  const uint slot = gl_GlobalInvocationID.x;
  if (slot >= count) return;
  const uint from = arrived[slot], begin = start[key[from]], end = start[key[from] + 1u];
  if (end - begin > kBinLimit)
    target[slot] = order[slot];
  else
    target[placeOf(from, begin, end)] = from;
}
