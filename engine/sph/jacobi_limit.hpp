#pragma once
#include "sph/kernel.hpp"

namespace rill {

/// Largest relaxation factor omega with which the Jacobi iteration converges on a rest lattice, dimensionless; 0.77 for Wendland at h = 2
/// d. Von Neumann analysis, linearized and without clamping: an iteration multiplies a compression wave with wave vector k by
///   1 - omega |sum_j grad K_j sin(k x_j)|^2 / sum_j |grad K_j|^2,
/// which must be at least -1 for all k.
double maxJacobiRelaxation(const SmoothingKernel& kernel);

}  // namespace rill
