#pragma once
// What solids do to a particle: the density that they displace, and how much of the kernel they cover.
#include "rill/scene.hpp"

namespace rill {

/// Contribution of solids to a particle.
struct SolidSample {
  double value = 0;              ///< added to rho_i / rho0, dimensionless
  Double3 gradient = {0, 0, 0};  ///< 1/m, d value / d x_i with the gradient kernel; points into the solid
  /// The symmetric tensor sum of value (1 - n n^T) over solids with normals n. The pressure force along a surface lacks it: for a linear
  /// pressure, sum_j (lambda_i + lambda_j) grad K_ij has the fraction 1 - coverage (integration by parts, continuous kernel).
  Double3 coverage = {0, 0, 0};       ///< xx, yy, zz
  Double3 coverageMixed = {0, 0, 0};  ///< yz, zx, xy; 0 where all surfaces are along the axes

  /// Adds the coverage of a surface that displaces `displaced`, with a normal of this direction (of any length).
  void cover(double displaced, const Double3& direction);
};

/// What solids do to a correction: the neighbors' share is multiplied by this symmetric matrix, (1 - coverage)^-1.
struct SolidScale {
  Double3 diagonal = {1, 1, 1};  ///< xx, yy, zz
  Double3 mixed = {0, 0, 0};     ///< yz, zx, xy
};

/// Eigenvalues of the coverage are bounded by kMaxSolidCoverage: axis by axis where surfaces are along the axes, else by a common factor.
SolidScale solidScale(const SolidSample& sample);

}  // namespace rill
