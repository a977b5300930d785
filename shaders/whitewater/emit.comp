#version 460
// New diffuse particles behind the others, in the order of the fluid particles that emit them.
#extension GL_GOOGLE_include_directive : require
#include "whitewater/whitewater.glsl"

layout(local_size_x = kWhiteGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Place { uvec4 place[]; };
layout(std430, set = 0, binding = 1) readonly buffer Surface { vec4 surface[]; };
layout(std430, set = 0, binding = 2) readonly buffer Motion { vec4 motion[]; };
layout(std430, set = 0, binding = 3) readonly buffer Start { uint start[]; };
layout(std430, set = 0, binding = 4) readonly buffer Births { uint births[]; };  // scanned
layout(std430, set = 0, binding = 5) readonly buffer Alive { uint alive[]; };    // scanned
layout(std430, set = 0, binding = 6) buffer WhitePlace { vec4 white_place[]; };
layout(std430, set = 0, binding = 7) buffer WhiteMotion { uvec4 white_motion[]; };
layout(std430, set = 0, binding = 8) buffer Counts { uint counts[]; };

#ifdef SOLIDS
#define WHITE_SOLIDS 9
#define WHITE_MESHES 10
#endif
#include "whitewater/white_solids.glsl"

// Evenly in the ball of radius 1, by three of the hash's numbers.
vec3 inBall(uint hash, uint first) {
  const float z = 2.0 * unit(whiteNumber(hash, first)) - 1.0, turn = 6.2831853 * unit(whiteNumber(hash, first + 1u));
  const float ring = sqrt(max(1.0 - z * z, 0.0)), r = pow(unit(whiteNumber(hash, first + 2u)), 1.0 / 3.0);
  return r * vec3(ring * cos(turn), ring * sin(turn), z);
}

void main() {
  const uint slot = flatInvocation();
  if (slot >= start[white.bins]) return;
  const uint from = births[slot], count = min(births[slot + 1u] - from, mostBirths()), first = alive[white.room] + from;
  const vec3 x = uintBitsToFloat(place[slot].xyz), v = motion[slot].xyz;
  // A particle with much surface starts as spray if it moves outward, else as foam; deep ones as bubbles.
  const bool deep = surface[slot].w < 0.2;
  const bool leaves = dot(v, surface[slot].xyz) > kWhiteCrestCosine * length(v);
  const uint kind = deep ? kWhiteBubble : leaves ? kWhiteSpray : kWhiteFoam;
  for (uint k = 0u; k < count && first + k < white.room; ++k) {
    const uint hash = whiteHash(white.seed, slot, counts[kWhiteSteps], k);
    // Along the way that the particle has come in the step, so that none come in bursts
    vec3 at = x + white.spacing * inBall(hash, 0u) - unit(whiteNumber(hash, 3u)) * white.seconds * v;
    for (uint side = 0u; side < 6u; ++side) {
      if ((white.walls >> side & 1u) == 0u) continue;
      const uint axis = side >> 1u;
      at[axis] = (side & 1u) == 0u ? max(at[axis], domainLow()[axis]) : min(at[axis], domainHigh()[axis]);
    }
    vec3 thrown = v + kWhiteSpread * length(v) * inBall(hash, 4u);
    if (holdBack(x, at, thrown, 0.0) && (insideSolid(at) || beyondWalls(at) > 0.0)) at = x;
    white_place[first + k] = vec4(at, 0.0);
    white_motion[first + k] = uvec4(floatBitsToUint(thrown), hash << 2u | kind);
    atomicAdd(counts[kWhiteSprayCount + kind], 1u);
  }
}
