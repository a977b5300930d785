#pragma once
#include <span>
#include <vector>

#include "rill/offline.hpp"

namespace rill::apps {

/// The figures of a run at one instant.
struct Instant {
  double time_s = 0;
  offline::Stats stats;
};

/// Kinetic plus potential energy.
struct EnergyFigures {
  double start_J = 0, max_J = 0, end_J = 0;
  /// Max over start, of the fluid that is there, with potential energy measured from the domain's lowest corner; NaN where the start is 0.
  double ratio = 1;
  double end_ratio = 1;  ///< end over start, likewise
};
EnergyFigures energyFigures(const Scene& scene, std::span<const Instant> run);

/// Density error over the run without its first tenth: mean of means, maximum of p99 and max, median of medians.
struct DensityFigures {
  double mean = 0, p99 = 0, max = 0, signed_median = 0;
};
DensityFigures densityFigures(std::span<const Instant> run);

double wallSeconds(std::span<const Instant> run);  ///< of the simulation alone

}  // namespace rill::apps
