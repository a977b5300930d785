#pragma once
#include "bench/bench.hpp"

namespace rill::bench {

/// Baselines of the suite "speed": a naive search against a grid, one struct a particle against separate arrays.
/// Cases are named "baseline-10k".
struct Baselines {
  size_t parts(const Bench& bench) const;  ///< that they count as in progress
  /// Adds a table each, and fails the report where two that should give the same do not.
  Expected<void> run(Bench& bench, Report& report) const;
};

}  // namespace rill::bench
