// Artificial pressure between close pairs: see engine/sph/artificial_pressure.hpp.
#ifndef RILL_FLUID_ARTIFICIAL_PRESSURE_GLSL
#define RILL_FLUID_ARTIFICIAL_PRESSURE_GLSL
#include "fluid/kernel.glsl"

float tensileScale = params.valueScale * params.tensileInverse;
float tensileLeast = params.tensileLeast;

// x to the power n; whole ones, up to 16, by squares, which is several times as fast.
float tensilePower(float x) {
  if (TENSILE_POWER == 0u) return pow(x, params.tensilePower);
  float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  float power = (TENSILE_POWER & 16u) != 0u ? x8 * x8 : 1.0;
  if ((TENSILE_POWER & 8u) != 0u) power *= x8;
  if ((TENSILE_POWER & 4u) != 0u) power *= x4;
  if ((TENSILE_POWER & 2u) != 0u) power *= x2;
  if ((TENSILE_POWER & 1u) != 0u) power *= x;
  return power;
}

float tensileAtRest = tensilePower(tensileLeast);

// 0 to 1, for a pair at `distance` (m). Powers of kernel values near 0 would be denormals, with which CPUs are
// slow, so values below that of neighbors at rest count as that.
float artificialPressure(float distance) {
  return tensilePower(clamp(kernelShape(distance) * tensileScale, tensileLeast, 1.0)) - tensileAtRest;
}
#endif
