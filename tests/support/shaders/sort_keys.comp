// key[i] = source[i]. COUNTED: counting the keys (KeySortDesc::fusedEnds).
#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef COUNTED
#define COUNTERS 2
#include "sort/count.glsl"
#endif
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Source { uint source[]; };
layout(binding = 1) writeonly buffer Keys { uint key[]; };
layout(push_constant) uniform Push { uint count; };
void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  key[i] = source[i];
#ifdef COUNTED
  countKey(i, source[i]);
#endif
}
