#pragma once
#include <span>
#include <vector>

#include "rill/offline.hpp"

namespace rill::apps {

/// The figures of a run at one time.
struct Instant {
  double time_s = 0;
  offline::Stats stats;
};

/// Kinetic and potential energy, summed.
struct EnergyFigures {
  double start_J = 0, max_J = 0, end_J = 0;
  double ratio = 1;      ///< max over start, potential energy counted from the domain's lowest corner; NaN where the start has none
  double end_ratio = 1;  ///< end over start, likewise
};
EnergyFigures energyFigures(const Scene& scene, std::span<const Instant> run);

/// Compression over the run without its first tenth: the mean of means, the worst of the others, the median of medians.
struct DensityFigures {
  double mean = 0, p99 = 0, max = 0, signed_median = 0;
};
DensityFigures densityFigures(std::span<const Instant> run);

double wallSeconds(std::span<const Instant> run);  ///< of the simulation alone

}  // namespace rill::apps
