// How much of the kernel is inside solids, as a symmetric tensor: the sum over them of displaced density times (1 - n n^T).
#ifndef RILL_SOLID_COVERAGE_GLSL
#define RILL_SOLID_COVERAGE_GLSL
#include "fluid/solid_samples.glsl"

struct SolidCoverage {
  vec3 diagonal;
  vec3 mixed;  // yz, zx, xy
};

// Of a surface with this normal direction (of any length).
void cover(inout SolidCoverage c, float displaced, vec3 direction) {
  float square = dot(direction, direction);
  if (square <= 0.0) return;
  c.diagonal += displaced * (1.0 - direction * direction / square);
  c.mixed -= displaced * (direction.yzx * direction.zxy / square);
}

// Largest eigenvalue of a symmetric matrix (Smith 1961).
float largestEigenvalue(mat3 m) {
  float mean = (m[0].x + m[1].y + m[2].z) / 3.0;
  mat3 rest = m - mat3(mean);
  float size = sqrt((dot(rest[0], rest[0]) + dot(rest[1], rest[1]) + dot(rest[2], rest[2])) / 6.0);
  if (size <= 1.0e-6 * mean) return mean;
  return mean + 2.0 * size * cos(acos(clamp(0.5 * determinant(rest / size), -1.0, 1.0)) / 3.0);
}

// The tangential scale, 1 / (1 - coverage), for SolidScale. Surfaces along the axes are bounded axis by axis, others together.
vec4 packSolidScale(SolidCoverage c) {
  if (c.mixed == vec3(0.0)) {
    vec3 bounded = min(c.diagonal, vec3(kMaxSolidCoverage));
    return vec4(bounded / (1.0 - bounded), 0.0);
  }
  mat3 m = mat3(c.diagonal.x, c.mixed.z, c.mixed.y, c.mixed.z, c.diagonal.y, c.mixed.x, c.mixed.y, c.mixed.x, c.diagonal.z);
  mat3 scale = inverse(mat3(1.0) - m * min(1.0, kMaxSolidCoverage / max(largestEigenvalue(m), 1.0e-6)));
  return vec4(vec3(scale[0].x, scale[1].y, scale[2].z) - 1.0, packMixed(vec3(scale[1].z, scale[0].z, scale[0].y)));
}
#endif
