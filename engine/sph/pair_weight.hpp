#pragma once
#include "sph/kernel.hpp"

namespace rill {

/// Weight of a pair at distance q over the support, of viscosity and diffusion: (1 - q)^3, 0 beyond the support.
double pairWeight(double q);

/// The sum of pairWeight q^power over the neighbors of a particle of the rest lattice.
double pairMoment(const SmoothingKernel& kernel, int power);

}  // namespace rill
