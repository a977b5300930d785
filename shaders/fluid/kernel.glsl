// The smoothing kernel and its gradient without their constant factors, which sums over neighbors
// are multiplied by at their end: params.valueScale makes K sum to 1 over the rest lattice, and
// params.gradientScale gives (dK/dr) / r in 1/m^2, which times x_i - x_j is the gradient at i.
// Needs a uniform block `params`.
#ifndef RILL_KERNEL_GLSL
#define RILL_KERNEL_GLSL
#include "fluid/constants.glsl"

// Loaded once: lavapipe loads a uniform lane by lane wherever it is used, which doubled the cost of
// a pass over the list.
float inverseSupport = params.inverseSupport;

// K / valueScale at distance r; 0 beyond the support.
float kernelShape(float r) {
  float q = r * inverseSupport;
  if (KERNEL == 0) {
    float t = max(1.0 - q, 0.0), t2 = t * t;
    return t2 * t2 * (1.0 + 4.0 * q);
  }
  float t = max(1.0 - q * q, 0.0);
  return t * t * t;
}

// (dK/dr) / r / gradientScale, never negative; the scale is.
float gradientShape(float r) {
  float q = r * inverseSupport;
  float t = max(1.0 - q, 0.0);
  if (KERNEL == 0) return t * t * t;
  return t * t / max(q, 1.0e-6);
}

// Both at once.
void kernelShapes(float r, out float value, out float gradient) {
  if (KERNEL == 0) {
    float q = r * inverseSupport;
    float t = max(1.0 - q, 0.0), t3 = t * t * t;
    value = t3 * t * (1.0 + 4.0 * q);
    gradient = t3;
  } else {
    value = kernelShape(r);
    gradient = gradientShape(r);
  }
}
#endif
