#pragma once
#include <array>
#include <span>
#include <vector>

#include "shared/run_figures.hpp"

namespace rill::bench {

/// Dimensionless global quantities of a run over time: center of mass and front divided by the initial extent of the fluid, energies
/// divided by the initial energy.
struct Trajectory {
  static constexpr size_t kQuantities = 6;  ///< center of mass x, y, z; front; kinetic and potential energy
  std::vector<std::array<double, kQuantities>> at;
};

/// `length` in m and `energy` in J (both > 0) are the units of the dimensionless quantities.
Trajectory trajectoryOf(std::span<const apps::Instant> run, double length, double energy);

/// The mean of runs that differ only in their seed.
Trajectory meanTrajectory(std::span<const Trajectory> seeds);

/// Root mean square of the differences over all instants and quantities; infinite if one is NaN.
double rmsDistance(const Trajectory& a, const Trajectory& b);

}  // namespace rill::bench
