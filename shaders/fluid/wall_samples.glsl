// What walls and solids do to a particle that they are near, in two arrays, each as large as the positions; undefined for others:
// nearDisplaced, the gradient of the displaced density, with its value in w; and nearTangential, the diagonal of the tangential scale less
// 1, with the rest packed in w.
#ifndef RILL_WALL_SAMPLES_GLSL
#define RILL_WALL_SAMPLES_GLSL
#include "shared/arrays.glsl"

// What a wall does to a correction: the neighbors' share is multiplied by a symmetric matrix that
// makes up, along each wall, for the support that is missing behind it.
struct WallScale {
  vec3 diagonal;
  vec3 mixed;  // yz, zx, xy; 0 where all walls are along the axes
};
const WallScale kNoWalls = WallScale(vec3(1.0), vec3(0.0));

// The neighbors' share, scaled, and that of the walls. `solids`: there are any; without them nothing is off the diagonal.
vec3 atWalls(WallScale s, bool solids, vec3 neighbors, vec3 wall) {
  vec3 sum = s.diagonal * neighbors + wall;
  if (solids) sum += s.mixed.zxy * neighbors.yzx + s.mixed.yzx * neighbors.zxy;
  return sum;
}

// D of docs/method.md: of the gradient's sum and its squares, and `more`.
float stiffnessAtWalls(WallScale s, vec3 gradient, float squares, float more) {
  float sum = dot(gradient, s.diagonal * gradient) + squares * (s.diagonal.x + s.diagonal.y + s.diagonal.z) / 3.0 + more;
  sum += 2.0 * dot(s.mixed, gradient.yzx * gradient.zxy);
  return sum;
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

WallScale unpackWallScale(vec4 stored) { return WallScale(1.0 + stored.xyz, unpackMixed(stored.w)); }

// Of particle i with this list head; 0 where no wall is near.
#define READ_NEAR_DISPLACED(BINDING) \
  READ_FLOAT4(BINDING, nearDisplaced) \
  vec4 displacedAt(uint i, uint head) { return (head & kNearWallsBit) != 0u ? nearDisplacedAt(i) : vec4(0.0); }
#define READ_NEAR_TANGENTIAL(BINDING) \
  READ_FLOAT4(BINDING, nearTangential) \
  WallScale wallScaleAt(uint i, uint head) { return unpackWallScale((head & kNearWallsBit) != 0u ? nearTangentialAt(i) : vec4(0.0)); }
#endif
