#pragma once
// What a fluid at rest reads once it has left the lattice of a fill. See docs/notes/rest-state.md.
#include "sph/kernel.hpp"

namespace rill {

/// Factor on the kernel's sum with which a liquid at rest has rest density: 1 over the least of the sums over the cubic, the body-centered
/// and the face-centered cubic lattice, at one particle per d^3, which is what a melt tends to. 1 .. 1.01: 1 where the cubic lattice has
/// the least sum, and for Poly6Spiky, whose particles move along another kernel's gradient; at most 1.01 for supports as short as neighbors
/// are far.
double liquidScale(const SmoothingKernel& kernel);

}  // namespace rill
