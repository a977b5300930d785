// Antialiased silhouettes: coverage from the excess of a weighted sum of centers around a ray over a threshold.

const float kCoverReach = 1.2;  // spacings: distance to a ray at which a center's weight is zero
// Change of the sum per spacing across an edge: 1.22 at a ball's, 1.28 at that of a half-plane with a particle per square spacing.
const float kCoverSlope = 1.25;
// Thresholds of the sum. With planes, centers are weighted by their plane's slant (surface_blend.glsl); depth filters have no planes
// (surface_coverage.glsl).
const float kCoverThresholdPlanes = 0.6;
const float kCoverThreshold = 0.7;

// A center's summand: 1 if the ray passes through it. `inverse`: 1 / (kCoverReach in m)^2.
float centerWeight(vec3 center, vec2 axis, float inverse) {
  const float weight = max(1.0 - raySquare(center, axis) * inverse, 0.0);
  return weight * weight;
}

float coverageAt(float excess, float depth) {
  return clamp(0.5 + excess * spacingAt(depth) / (kCoverSlope * metersAPixel(depth)), 0.0, 1.0);
}
