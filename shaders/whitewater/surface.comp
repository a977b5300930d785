#version 460
// Of each fluid particle: the normal and the area of its part of the surface, and the strain rate of the flow around it.
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "whitewater/whitewater.glsl"

layout(local_size_x = kWhiteGroup) in;
READ_UINT4(0, place)
READ_FLOAT4(1, motion)
READ_UINT(2, start)
layout(std430, set = 0, binding = 3) writeonly buffer Surface { vec4 surface[]; };  // normal out of the fluid; area in squared spacings
layout(std430, set = 0, binding = 4) writeonly buffer Strain { float strain[]; };   // 1/s
layout(std430, set = 0, binding = 5) buffer Counts { uint counts[]; };
#ifdef SOLIDS
#define WHITE_SOLIDS 6
#define WHITE_MESHES 7
#endif
#include "whitewater/white_solids.glsl"
#include "whitewater/white_walk.glsl"

vec3 here;  // velocity
vec3 slope = vec3(0.0);                                    // of the fluid's share, over supports
vec3 straight = vec3(0.0), mixed = vec3(0.0);              // sums of x x^T, x in spacings; mixed: xy, xz, yz
vec3 alongX = vec3(0.0), alongY = vec3(0.0), alongZ = vec3(0.0);  // columns of the sum of dv x^T

void visit(uint slot, vec3 to, float square) {
  const float rest = 1.0 - square, weight = kWhiteKernel * rest * rest * rest;
  const vec3 x = to / white.spacing, dv = weight * (motionAt(slot).xyz - here);
  slope += 6.0 * kWhiteKernel * rest * rest / support() * to;
  straight += weight * x * x;
  mixed += weight * x.xxy * x.yzz;
  alongX += dv * x.x;
  alongY += dv * x.y;
  alongZ += dv * x.z;
}

void main() {
  const uint slot = flatInvocation();
  if (slot >= startAt(white.bins)) return;
  const vec3 x = uintBitsToFloat(placeAt(slot).xyz);
  here = motionAt(slot).xyz;
  if (dot(here, here) < kWhiteSlow) {
    surface[slot] = vec4(0.0);
    strain[slot] = 0.0;
    return;
  }
  if (!walk(x)) atomicAdd(counts[kWhiteBoundHits], 1u);

  // Behind walls and in solids as much fluid as here is taken to be
  slope += slopeOfSolids(x);
  for (uint side = 0u; side < 6u; ++side) {
    const float wall = wallDistance(x, side), sign = (side & 1u) == 0u ? 1.0 : -1.0;
    slope[side >> 1u] -= sign * shareSlope(wall);
  }
  const float steep = length(slope);
  surface[slot] = vec4(steep > 1e-6 ? -slope / steep : vec3(0.0), 2.0 * steep / kWhiteSupport);

  // The gradient that fits the velocities around best. Along axes without neighbors it is 0.
  const float trace = straight.x + straight.y + straight.z;
  const vec3 squares = straight + 1e-3 * trace;
  const mat3 spread = mat3(vec3(squares.x, mixed.xy), vec3(mixed.x, squares.y, mixed.z), vec3(mixed.yz, squares.z));
  mat3 gradient = mat3(0.0);
  if (trace > 1e-3) gradient = mat3(alongX, alongY, alongZ) * inverse(spread);
  const mat3 rates = 0.5 * (gradient + transpose(gradient));
  const float rate = sqrt(2.0 * (dot(rates[0], rates[0]) + dot(rates[1], rates[1]) + dot(rates[2], rates[2]))) / white.spacing;
  strain[slot] = min(rate, 1e6);
}
