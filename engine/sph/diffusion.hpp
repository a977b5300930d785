#pragma once
// Diffusion of a concentration between particles, dc/dt = D lap c. See docs/notes/diffusion.md.
#include "sph/kernel.hpp"

namespace rill {

/// Of a pair, at distance q over the support. It is (dK/dr) / r of Wendland's kernel but for a factor, and finite for coincident particles.
double diffusionWeight(double q);

/// The factor c on  dc_i/dt = c sum_j diffusionWeight(|q|) (c_j - c_i),  q = (x_i - x_j) / h,  1/s, with which the rest lattice has the
/// diffusivity (m^2/s):  c = 6 diffusivity / (h^2 sum diffusionWeight q^2).
double diffusionRate(double diffusivity, const SmoothingKernel& kernel);

/// The sum over j of diffusionWeight in the rest lattice.
double diffusionRow(const SmoothingKernel& kernel);

}  // namespace rill
