#pragma once
// Tension between liquids, by the samples of sph/surface_tension.hpp. See docs/notes/surface-tension.md.
//
// A sample of a particle of fluid a is covered by particles of fluid b m_ab as much as by its own ones:
//   c_ik = C sum_j m_ab W(|q_ik - x_j| / s),   m_aa = 1,   0 <= m_ab = m_ba <= 1.
// With m_ab = 1 both are as one fluid. With m_ab = 0 each has its surface as in air, and the interface has both tensions.
#include <array>

#include "rill/materials.hpp"

namespace rill {

using InterfaceCover = std::array<std::array<double, kMaxFluids>, kMaxFluids>;  ///< m_ab

/// That of fluids without tension between them.
InterfaceCover wholeCover();

/// m_ab of two fluids whose interface has `share`, 0 .. 1, of the sum of their tensions against air.
double interfaceCover(double share);

}  // namespace rill
