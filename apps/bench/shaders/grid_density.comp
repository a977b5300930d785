// Grid search: nine rows of three cells around a particle. STRUCT: array of structures instead of separate arrays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "cloud.h"
#include "pair.glsl"
#include "shared/dispatch.glsl"
layout(local_size_x = kCloudGroup) in;
layout(push_constant) uniform PushBlock { CloudPush push; };
#ifdef STRUCT
struct Particle {
  vec4 position, velocity, prediction, correction;
  float density, multiplier, mass;
  uint id;
};
layout(binding = 0, std430) readonly buffer Particles { Particle particle[]; };
#define POSITION(i) particle[i].position.xyz
#else
layout(binding = 0, std430) readonly buffer Positions { vec4 position[]; };
#define POSITION(i) position[i].xyz
#endif
layout(binding = 1, std430) readonly buffer Starts { uint start[]; };
layout(binding = 2, std430) writeonly buffer Results { vec2 result[]; };
#include "cell.glsl"

void main() {
  const uint i = flatInvocation();
  if (i >= push.count) return;
  PairSum sum = PairSum(0.0, 0u);
  const vec3 here = POSITION(i);
  const ivec3 home = cellOf(here);
  for (int row = 0; row < 9; ++row) {
    const ivec3 cell = home + ivec3(0, row % 3 - 1, row / 3 - 1);
    if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, cells()))) continue;
    const uint begin = start[cellKey(ivec3(max(cell.x - 1, 0), cell.yz))];
    const uint end = start[cellKey(ivec3(min(cell.x + 1, cells().x - 1), cell.yz)) + 1u];
    for (uint j = begin; j < end; ++j) addPair(sum, here, POSITION(j), push.radius);
  }
  result[i] = vec2(sum.density, sum.neighbors);
}
