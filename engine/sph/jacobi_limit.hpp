#pragma once
#include "sph/kernel.hpp"

namespace rill {

/// The largest under-relaxation omega with which Jacobi corrections of a rest lattice's density converge, linearized and unclamped: a wave
/// of compression with wave vector k comes back as 1 - omega |sum_j grad K_j sin(k x_j)|^2 / sum_j |grad K_j|^2 of itself, which must not
/// be under -1 for any k. Dimensionless; 0.77 for the kernel of Wendland at h = 2 d.
double jacobiLimit(const SmoothingKernel& kernel);

}  // namespace rill
