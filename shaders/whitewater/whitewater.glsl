// What passes of whitewater share. Positions are in m, relative to the fluid's origin.
#ifndef RILL_WHITEWATER_GLSL
#define RILL_WHITEWATER_GLSL
#include "shared/active.glsl"
#include "shared/dispatch.glsl"
#include "whitewater/white_hash.h"
#include "whitewater/whitewater_records.h"

layout(push_constant) uniform PushBlock { WhitePush white; };

// Of one fluid particle in one step; 32 bits hold the sum of all.
uint mostBirths() { return min(kWhiteMaxBirths, 0x80000000u / max(white.capacity, 1u)); }

float support() { return kWhiteSupport * white.spacing; }
vec3 gravity() { return vec3(white.gravityX, white.gravityY, white.gravityZ); }
vec3 domainLow() { return vec3(white.lowX, white.lowY, white.lowZ); }
vec3 domainHigh() { return vec3(white.highX, white.highY, white.highZ); }

bool inGrid(vec3 x) { return isWithin(x / support(), kWhiteFar); }
ivec3 cellAt(vec3 x) { return ivec3(floor(x / support())); }
uint binOf(ivec3 cell) { return whiteBin(uint(cell.x), uint(cell.y), uint(cell.z), white.bins); }
uint columnOf(ivec2 cell) { return uint(cell.x) << 16u | uint(cell.y) & 0xffffu; }  // tells neighbors apart
// How far the flow is from smooth, 0 to 1, by its acceleration over that of gravity.
float brokenUp(float acceleration) {
  const float inertia = acceleration / max(length(gravity()), 1e-3);
  return clamp((inertia - kWhiteInertiaLow) / (kWhiteInertiaHigh - kWhiteInertiaLow), 0.0, 1.0);
}

float unit(uint number) { return float(number >> 8u) * (1.0 / 16777216.0); }  // [0, 1)

// Kernel over the spacing's cube, of a squared distance in supports.
const float kWhiteKernel = 315.0 / (64.0 * 3.14159265 * kWhiteSupport * kWhiteSupport * kWhiteSupport);
float kernelAt(float square) {
  const float rest = max(1.0 - square, 0.0);
  return kWhiteKernel * rest * rest * rest;
}
// The kernel's share on the near side of a plane at a distance in supports, and its derivative.
float shareWithin(float distance) {
  const float s = clamp(distance, -1.0, 1.0), t = s * s;
  return 0.5 + 315.0 / 256.0 * s * (1.0 + t * (-4.0 / 3.0 + t * (1.2 + t * (-4.0 / 7.0 + t / 9.0))));
}
float shareSlope(float distance) {
  const float rest = max(1.0 - distance * distance, 0.0);
  return 315.0 / 256.0 * rest * rest * rest * rest;
}
// Distance to a closed side, 0 to 5, in supports; far without a wall there.
float wallDistance(vec3 x, uint side) {
  if ((white.walls >> side & 1u) == 0u) return 2.0;
  const uint axis = side >> 1u;
  return ((side & 1u) == 0u ? x[axis] - domainLow()[axis] : domainHigh()[axis] - x[axis]) / support();
}
// The kernel's share inside of the walls.
float shareInside(vec3 x) {
  float share = 1.0;
  for (uint side = 0u; side < 6u; ++side) share *= shareWithin(wallDistance(x, side));
  return share;
}
// Distance beyond the closed sides of the domain, m; 0 inside.
float beyondWalls(vec3 x) {
  float beyond = 0.0;
  for (uint side = 0u; side < 6u; ++side) beyond = max(beyond, -support() * wallDistance(x, side));
  return beyond;
}
#endif
