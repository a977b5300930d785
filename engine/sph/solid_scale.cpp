#include "sph/solid_scale.hpp"

#include <algorithm>
#include <cmath>

#include "shared/fluid_records.h"

namespace rill {

void SolidSample::cover(double displaced, const Double3& direction) {
  double square = 0;
  for (int a = 0; a < 3; ++a) square += direction[a] * direction[a];
  if (square <= 0) return;
  for (int a = 0; a < 3; ++a) {
    coverage[a] += displaced * (1 - direction[a] * direction[a] / square);
    coverageMixed[a] -= displaced * direction[(a + 1) % 3] * direction[(a + 2) % 3] / square;
  }
}

SolidScale solidScale(const SolidSample& sample) {
  const Double3 &d = sample.coverage, &m = sample.coverageMixed;
  SolidScale scale;
  if (m[0] == 0 && m[1] == 0 && m[2] == 0) {
    for (int a = 0; a < 3; ++a) scale.diagonal[a] = 1 / (1 - std::min<double>(d[a], kMaxSolidCoverage));
    return scale;
  }
  // Largest eigenvalue of the coverage (Smith 1961).
  const double mean = (d[0] + d[1] + d[2]) / 3;
  double squares = 0;
  for (int a = 0; a < 3; ++a) squares += (d[a] - mean) * (d[a] - mean) + 2 * m[a] * m[a];
  const double size = std::sqrt(squares / 6), x = d[0] - mean, y = d[1] - mean, z = d[2] - mean;
  const double determinant = x * (y * z - m[0] * m[0]) - m[2] * (m[2] * z - m[0] * m[1]) + m[1] * (m[2] * m[0] - y * m[1]);
  const double largest =
      size > 0 ? mean + 2 * size * std::cos(std::acos(std::clamp(0.5 * determinant / (size * size * size), -1.0, 1.0)) / 3) : mean;
  const double bound = std::min(1.0, kMaxSolidCoverage / largest);
  // The inverse of 1 - bound * coverage, by cofactors.
  Double3 p, q;
  for (int a = 0; a < 3; ++a) {
    p[a] = 1 - bound * d[a];
    q[a] = -bound * m[a];
  }
  const double whole = p[0] * (p[1] * p[2] - q[0] * q[0]) - q[2] * (q[2] * p[2] - q[0] * q[1]) + q[1] * (q[2] * q[0] - p[1] * q[1]);
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    scale.diagonal[a] = (p[b] * p[c] - q[a] * q[a]) / whole;
    scale.mixed[a] = (q[b] * q[c] - p[a] * q[a]) / whole;
  }
  return scale;
}

}  // namespace rill
