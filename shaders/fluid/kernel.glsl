// The smoothing kernel and its gradient, scaled by a particle's volume: K sums to 1 over the rest lattice.
// Constant 0 chooses: 0 Wendland C2 for both, 1 poly6 with the spiky gradient (Macklin and Mueller 2013).
#ifndef RILL_KERNEL_GLSL
#define RILL_KERNEL_GLSL
layout(constant_id = 0) const uint KERNEL = 0;

// Needs a uniform block `params`. K at distance r; 0 beyond the support.
float kernelValue(float r) {
  float q = r * params.inverseSupport;
  if (KERNEL == 0) {
    float t = max(1.0 - q, 0.0), t2 = t * t;
    return params.valueScale * t2 * t2 * (1.0 + 4.0 * q);
  }
  float t = max(1.0 - q * q, 0.0);
  return params.valueScale * t * t * t;
}

// (dK/dr) / r, 1/m^2, never positive; times x_i - x_j it is the gradient at i.
float kernelGradient(float r) {
  float q = r * params.inverseSupport;
  float t = max(1.0 - q, 0.0);
  if (KERNEL == 0) return -params.gradientScale * t * t * t;
  return -params.gradientScale * t * t / max(q, 1.0e-6);
}

// Both at once.
void kernelBoth(float r, out float value, out float gradient) {
  if (KERNEL == 0) {
    float q = r * params.inverseSupport;
    float t = max(1.0 - q, 0.0), t3 = t * t * t;
    value = params.valueScale * t3 * t * (1.0 + 4.0 * q);
    gradient = -params.gradientScale * t3;
  } else {
    value = kernelValue(r);
    gradient = kernelGradient(r);
  }
}
#endif
