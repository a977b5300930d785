#version 460
// Before a step: counts of the step, and the dispatch over the diffuse particles.
#extension GL_GOOGLE_include_directive : require
#include "whitewater/whitewater.glsl"

layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Arguments { uint arguments[]; };

void main() {
  const uint count = min(counts[kWhiteCount], white.room);
  counts[kWhiteBefore] = count;
  counts[kWhiteLost] = 0u;
  for (uint k = 0u; k < kWhiteClasses; ++k) counts[kWhiteSprayCount + k] = 0u;
  const uvec3 groups = foldGroups(divideUp(count, kWhiteGroup));
  arguments[0] = groups.x;
  arguments[1] = groups.y;
  arguments[2] = groups.z;
}
