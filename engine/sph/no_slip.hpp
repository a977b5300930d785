#pragma once
// How strongly viscous fluid sticks to a solid. See docs/notes/slip.md.
#include <vector>

#include "sph/half_space.hpp"

namespace rill {

/// Q(s), m, at signed distance s (m). Times |grad B| of a solid it is the coefficient of a particle's velocity relative to the solid, in
/// units of the factor c of sph/viscosity.hpp: of a plane wall what ghost layers add to the force along it whose velocity goes on linearly
/// from the particle's, through the wall's at the wall,
///   Q(s) |F'(s)| = sum_ghosts w_k q_k^2 b_k / s,  w the viscous weight, q along the wall, b_k = s + d/2 + k d from the particle.
/// For s < d/2 it is that at d/2, the smallest distance of centers.
double noSlipLength(const SmoothingKernel& kernel, double s);

/// At the nodes of HalfSpaceTable.
std::vector<float> makeNoSlipTable(const SmoothingKernel& kernel);

/// Its value by linear interpolation, as in the shaders; `step`: of the nodes, m.
double sampleNoSlip(const std::vector<float>& table, double step, double s);

}  // namespace rill
