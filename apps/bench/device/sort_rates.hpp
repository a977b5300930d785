#pragma once
// How fast a device sorts keys of cells, beside the host.
#include <string>
#include <vector>

#include "bench/bench.hpp"

namespace rill::bench {

struct SortRates {
  double counting = 0, radix = 0, stdSort = 0;  ///< million keys per second; NaN: not measured
  double took_s = 0;                            ///< to measure all of them
  bool stopped = false;                         ///< before there was a result
  std::vector<std::string> failures;
};

/// Runs the suite `sort` for `count` keys of cells.
Expected<SortRates> timeSorts(const Bench& bench, uint32_t count);

}  // namespace rill::bench
