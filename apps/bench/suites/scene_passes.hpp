#pragma once
// Which passes scenes run, and why they skip others.
#include "bench/bench.hpp"
#include "bench/suites/feature_cases.hpp"

namespace rill::bench {

/// Adds tables and results to `report`, and a failure for each scene without particles that runs a pass.
Expected<void> listPasses(Bench& bench, const std::vector<PassScene>& scenes, Report& report);

}  // namespace rill::bench
