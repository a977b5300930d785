#pragma once
// Viscosity as a force of pairs along their line (Weiler et al. 2018), which keeps linear and angular momentum. See
// docs/notes/viscosity.md.
#include "sph/pair_weight.hpp"

namespace rill {

/// The factor c on  dv_i/dt = c sum_j pairWeight(|q|) q (q . (v_j - v_i)),  q = (x_i - x_j) / h,  1/s, with which the rest lattice has
/// the dynamic viscosity `viscosity` (Pa s) as the mean over all directions:  c = viscosity / (density h^2 M),  M = 1/30 sum pairWeight
/// q^4.
double viscosityRate(double viscosity, double density, const SmoothingKernel& kernel);

/// A bound of the eigenvalues of 1 - dt (dv/dt) in the rest lattice; `coefficient`: the rate times dt.
double latticeBound(double coefficient, const SmoothingKernel& kernel);

}  // namespace rill
