#pragma once
// What a fluid at rest reads once it has left the lattice of a fill. See docs/notes/rest-state.md.
#include "sph/kernel.hpp"

namespace rill {

/// Factor on the kernel's sum with which a liquid at rest has rest density: one over the least of the sums over the cubic, the
/// body-centered and the face-centered cubic lattice, at one particle per d^3. 1 where the cubic lattice has the least sum, for supports
/// under 2 d, and for Poly6Spiky, whose particles move along the gradient of another kernel; at most 1.006.
double liquidScale(const SmoothingKernel& kernel);

}  // namespace rill
