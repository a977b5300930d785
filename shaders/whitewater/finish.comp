#version 460
// After a step: the number of diffuse particles, and the figures since the start.
#extension GL_GOOGLE_include_directive : require
#include "whitewater/whitewater.glsl"

layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) readonly buffer Births { uint births[]; };  // scanned
layout(std430, set = 0, binding = 1) readonly buffer Alive { uint alive[]; };    // scanned
layout(std430, set = 0, binding = 2) buffer Counts { uint counts[]; };

void add(uint word, uint what) {
  const uint sum = counts[word] + what;
  if (sum < what) counts[word + 1u] += 1u;
  counts[word] = sum;
}

void main() {
  const uint kept = alive[white.room], born = births[white.capacity], placed = min(born, white.room - kept);
  add(kWhiteEmitted, placed);
  add(kWhiteDissolved, counts[kWhiteBefore] - kept);
  add(kWhiteOverflow, born - placed);
  add(kWhiteOverflow, counts[kWhiteLost]);
  counts[kWhiteCount] = kept + placed;
  counts[kWhiteSteps] += 1u;
}
