#pragma once
#include <cstdint>

#include "sph/kernel.hpp"

namespace rill {

/// How the pressure that bears a column at its start is found: Jacobi iterations with heavy-ball momentum (Polyak 1964), in which nothing
/// moves. A wave of compression with wave number k, long beside the spacing, is corrected by a = omega k^2 / D in each, so that the longest
/// one of a column of L layers, which is pi / 2L a spacing, is the slowest; with momentum (1 - sqrt(a))^2 it fades by 1 - sqrt(a) an
/// iteration.
struct StartPressure {
  uint32_t iterations = 0;
  double momentum = 0;  ///< share of its last change that a multiplier goes on by, 0 .. 1
};

/// `relaxation`: omega, > 0. `regularization`: epsilon, a fraction of the rest lattice's D, >= 0. `layers`: of the column, in spacings, >
/// 0. At most `most` iterations: a column that asks for more starts with less pressure than it needs.
StartPressure startPressure(const SmoothingKernel& kernel, double relaxation, double regularization, double layers, uint32_t most);

}  // namespace rill
