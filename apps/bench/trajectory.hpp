#pragma once
#include <array>
#include <span>
#include <vector>

#include "shared/run_figures.hpp"

namespace rill::bench {

/// What a run does as a whole, at each of its instants, without dimension: center of mass and front over the fluid's first extent, energies
/// over the energy at the start.
struct Trajectory {
  static constexpr size_t kQuantities = 6;  ///< center x, y, z; front; kinetic; potential
  std::vector<std::array<double, kQuantities>> at;
};

/// `length` in m, `energy` in J, both > 0: what lengths and energies are divided by.
Trajectory trajectoryOf(std::span<const apps::Instant> run, double length, double energy);

/// Of runs that differ by chance alone, one of each seed.
Trajectory meanTrajectory(std::span<const Trajectory> seeds);

/// Root mean square of all differences, over instants and quantities; infinite where one is not a number.
double distance(const Trajectory& a, const Trajectory& b);

}  // namespace rill::bench
