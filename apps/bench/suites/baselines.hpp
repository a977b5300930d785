#pragma once
#include "bench/bench.hpp"

namespace rill::bench {

/// Baselines of the suite "speed": brute-force search against a grid, array of structures against separate arrays.
/// Cases are named "baseline-10k".
struct Baselines {
  size_t parts(const Bench& bench) const;  ///< of progress
  /// Adds one table per comparison, and a failure where the results of two variants differ.
  Expected<void> run(Bench& bench, Report& report) const;
};

}  // namespace rill::bench
