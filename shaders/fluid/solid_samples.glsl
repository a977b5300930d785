// What solids do to a particle that they are near, in two arrays, each as large as the positions: nearDisplaced, the gradient of the
// displaced density, that of mouths included, with its value in w, undefined for others; and nearTangential, the diagonal of the tangential
// scale less 1, with the rest packed in w, 0 for others.
#ifndef RILL_SOLID_SAMPLES_GLSL
#define RILL_SOLID_SAMPLES_GLSL
#include "shared/arrays.glsl"

// A symmetric matrix that makes up, along each surface, for the support that is missing behind it.
struct SolidScale {
  vec3 diagonal;
  vec3 mixed;  // yz, zx, xy; 0 where all surfaces are along the axes
};
const SolidScale kNoSolids = SolidScale(vec3(1.0), vec3(0.0));

vec3 scaled(SolidScale s, vec3 neighbors) {
  return s.diagonal * neighbors + s.mixed.zxy * neighbors.yzx + s.mixed.yzx * neighbors.zxy;
}

// A pair's correction is multiplied by 1 + b_i + b_j, so that it stays opposite for the two; b is this share of the scale less 1.
const float kScaleOfPair = 0.4;
vec3 scaledExcess(SolidScale s, vec3 neighbors) { return kScaleOfPair * (scaled(s, neighbors) - neighbors); }

// D of docs/method.md: of the gradient's sum and its squares, which are over the masses of the neighbors, and `more`.
float stiffnessAtSolids(SolidScale s, vec3 gradient, float inverseMass, float squares, float more) {
  return inverseMass * dot(gradient, scaled(s, gradient)) + squares * (s.diagonal.x + s.diagonal.y + s.diagonal.z) / 3.0 + more;
}

// Off the diagonal: at most 1/3, as three numbers of 10 bits around 512, a float that is neither denormal nor NaN. 0: none.
const float kMixedUnits = 1500.0;

float packMixed(vec3 mixed) {
  uvec3 q = uvec3(clamp(round(mixed * kMixedUnits) + 512.0, 12.0, 1012.0));
  return uintBitsToFloat(q.x | q.y << 10 | q.z << 20);
}

vec3 unpackMixed(float packed) {
  uint q = floatBitsToUint(packed);
  vec3 mixed = (vec3(q & 1023u, q >> 10 & 1023u, q >> 20) - 512.0) / kMixedUnits;
  return q == 0u ? vec3(0.0) : mixed;
}

SolidScale unpackSolidScale(vec4 stored) { return SolidScale(1.0 + stored.xyz, unpackMixed(stored.w)); }

const uint kDisplacedBits = kNearSolidsBit | kNearMouthsBit;

// Of particle i with this list head; 0 where no solid, and of the first no mouth, is near.
#define READ_NEAR_DISPLACED(BINDING) \
  READ_FLOAT4(BINDING, nearDisplaced) \
  vec4 displacedAt(uint i, uint head) { return (head & kDisplacedBits) != 0u ? nearDisplacedAt(i) : vec4(0.0); }
#define READ_NEAR_TANGENTIAL(BINDING) \
  READ_FLOAT4(BINDING, nearTangential) \
  SolidScale solidScaleAt(uint i, uint head) { return unpackSolidScale((head & kNearSolidsBit) != 0u ? nearTangentialAt(i) : vec4(0.0)); }
#endif
