// A silhouette a pixel wide, from what the sum of the centres around a ray exceeds its threshold by.

const float kCoverReach = 1.2;  // spacings from a ray at which a centre stops covering it
// Of the sum, over a spacing across an edge: 1.22 at the rim of a ball, 1.28 at that of a half-plane with a particle a square spacing.
const float kCoverSlope = 1.25;

float coverageAt(float excess, float depth) {
  return clamp(0.5 + excess * spacingAt(depth) / (kCoverSlope * metresAPixel(depth)), 0.0, 1.0);
}
