#pragma once
#include <cstdint>

#include "sph/kernel.hpp"

namespace rill {

/// Parameters of the solve for the initial hydrostatic pressure: Jacobi iterations with heavy-ball momentum (Polyak 1964) at fixed
/// positions. An iteration reduces a long compression wave with wave number k by a = omega k^2 / D. The slowest one in a column of L layers
/// has k = pi / (2 L d); momentum (1 - sqrt(a))^2 reduces its error by the factor 1 - sqrt(a) per iteration.
struct StartPressure {
  uint32_t iterations = 0;
  double momentum = 0;  ///< fraction of the last change of a multiplier that is added, 0 .. 1
};

/// `relaxation`: omega, > 0. `regularization`: epsilon as a fraction of the rest lattice's D, >= 0. `layers`: height of the column in
/// spacings, > 0. `maxIterations`: upper limit; higher columns start with a part of their pressure.
StartPressure startPressure(const SmoothingKernel& kernel, double relaxation, double regularization, double layers, uint32_t maxIterations);

}  // namespace rill
