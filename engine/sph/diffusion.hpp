#pragma once
// Diffusion of a concentration between particles, dc/dt = D lap c. See docs/notes/diffusion.md.
#include "sph/pair_weight.hpp"

namespace rill {

/// The factor c on  dc_i/dt = c sum_j pairWeight(|q|) (c_j - c_i),  q = (x_i - x_j) / h,  1/s, with which the rest lattice has the
/// diffusivity (m^2/s):  c = 6 diffusivity / (h^2 sum pairWeight q^2).
double diffusionRate(double diffusivity, const SmoothingKernel& kernel);

/// The sum over j of pairWeight in the rest lattice.
double diffusionRow(const SmoothingKernel& kernel);

}  // namespace rill
