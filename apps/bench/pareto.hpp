#pragma once
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rill::bench {

/// Cost and error. Points that are not finite are never on a Pareto front.
using CostError = std::pair<double, double>;

/// Indices of the Pareto front, by increasing cost. Of equal points, the first is on it.
std::vector<size_t> paretoFront(std::span<const CostError> points);

/// Cost at `error` on the Pareto front of `points`, interpolated linearly in log-log space; NaN outside its range.
double costAtError(std::span<const CostError> points, double error);

}  // namespace rill::bench
