#version 460
// Moves a diffuse particle by its class, ages it and says whether it lives on.
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "whitewater/whitewater.glsl"

layout(local_size_x = kWhiteGroup) in;
READ_UINT4(0, place)
READ_FLOAT4(1, motion)
READ_UINT(2, start)
layout(std430, set = 0, binding = 3) readonly buffer WhitePlace { vec4 white_place[]; };     // m; age, s
layout(std430, set = 0, binding = 4) readonly buffer WhiteMotion { uvec4 white_motion[]; };  // bits of m/s; tag: hash << 2 | class
layout(std430, set = 0, binding = 5) writeonly buffer MovedPlace { vec4 moved_place[]; };
layout(std430, set = 0, binding = 6) writeonly buffer MovedMotion { uvec4 moved_motion[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Alive { uint alive[]; };
layout(std430, set = 0, binding = 8) buffer Counts { uint counts[]; };
#ifdef SOLIDS
#define WHITE_SOLIDS 9
#define WHITE_MESHES 10
#endif
#include "whitewater/white_solids.glsl"
#include "whitewater/white_walk.glsl"

float weights = 0.0;
vec3 carried = vec3(0.0);

void visit(uint slot, vec3 to, float square) {
  const float weight = kernelAt(square);
  weights += weight;
  carried += weight * motionAt(slot).xyz;
}

void main() {
  const uint k = flatInvocation();
  if (k >= counts[kWhiteBefore]) return;
  const vec3 x = white_place[k].xyz, v = uintBitsToFloat(white_motion[k].xyz);
  const uint tag = white_motion[k].w, before = tag & 3u;
  const float step = white.seconds;
  // Where it is at the end of the step if the fluid does not change its velocity: there it meets the fluid of that time.
  const vec3 ahead = x + step * v + (before == kWhiteSpray ? 0.5 * step * step * gravity() : vec3(0.0));
  if (inGrid(ahead) && !walk(ahead)) atomicAdd(counts[kWhiteBoundHits], 1u);
  const float share = weights / max(shareInside(ahead) * shareOutside(ahead), 0.1);

  uint kind = share < kWhiteSprayBelow ? kWhiteSpray : share > kWhiteBubbleAbove ? kWhiteBubble : kWhiteFoam;
  const vec3 fluid = carried / max(weights, 1e-6);
  vec3 after = v + step * gravity();
  if (kind == kWhiteFoam) after = fluid;
  if (kind == kWhiteBubble) {
    // A bubble of no mass and half its volume of added mass starts with 2 g
    const float g = length(gravity());
    const vec3 rising = fluid - (g > 1e-3 ? kWhiteRise * gravity() / g : vec3(0.0));
    after = rising + exp(-step * 2.0 * g / kWhiteRise) * (v - rising);
  }
  vec3 to = x + 0.5 * step * (v + after);

  const float age = white_place[k].w + step * (kind == kWhiteBubble ? kWhiteBubbleAging : 1.0);
  bool lives = age < white.life * (0.5 + unit(pairMix(tag >> 2u))) && inGrid(to) && isWithin(after, 1e6);
  for (uint side = 0u; side < 6u; ++side) {
    if ((white.walls >> side & 1u) == 0u) continue;
    const uint axis = side >> 1u;
    const float wall = (side & 1u) == 0u ? domainLow()[axis] : domainHigh()[axis];
    const bool beyond = (side & 1u) == 0u ? to[axis] < wall : to[axis] > wall;
    if (!beyond) continue;
    to[axis] = wall;
    if (kind == kWhiteSpray) lives = false;  // it wets the wall
  }
  if (holdBack(x, to, after, step)) {
    if (kind == kWhiteSpray || insideSolid(to) || beyondWalls(to) > clearance()) lives = false;  // wets it; or between two
  }
  moved_place[k] = vec4(to, age);
  moved_motion[k] = uvec4(floatBitsToUint(after), tag & ~3u | kind);
  alive[k] = lives ? 1u : 0u;
}
