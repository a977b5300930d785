#pragma once
// Time against error of surface variants, as a table and a diagram.
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "bench/suites/surface_variants.hpp"

namespace rill::bench {

/// Cost and error of a variant, summed over shapes or frames.
struct SurfaceCost {
  const SurfaceVariant* variant = nullptr;
  double ms = 0, mean = 0, p95 = 0, count = 0;
};

void addCost(std::vector<SurfaceCost>& sums, const SurfaceVariant* variant, double ms, double mean, double p95);

/// Adds a table and a diagram of time against error with the Pareto front; default settings are emphasized. `first`: the default variant.
void tabulateCosts(const std::string& title, const std::string& what, const std::vector<SurfaceCost>& sums, const SurfaceVariant& first,
                   Report& report);

}  // namespace rill::bench
