// A silhouette a pixel wide, from what the sum of the centers around a ray exceeds its threshold by.

const float kCoverReach = 1.2;  // spacings from a ray at which a center stops covering it
// Of the sum, over a spacing across an edge: 1.22 at the rim of a ball, 1.28 at that of a half-plane with a particle a square spacing.
const float kCoverSlope = 1.25;
// Sums from which there is fluid. With planes each center is weighted by its plane's slant, in the
// loop that sums their heights (surface_blend.glsl); the filters have no planes and sum in a loop
// of their own (surface_cover.glsl). So there are two loops, and two thresholds.
const float kCoverSlanted = 0.6;
const float kCoverBare = 0.7;

// What a center adds to the sum: 1 where the ray passes through it. `inverse`: of the square of kCoverReach in m.
float coverOfCenter(vec3 center, vec2 axis, float inverse) {
  const float beside = max(1.0 - raySquare(center, axis) * inverse, 0.0);
  return beside * beside;
}

float coverageAt(float excess, float depth) {
  return clamp(0.5 + excess * spacingAt(depth) / (kCoverSlope * metersAPixel(depth)), 0.0, 1.0);
}
