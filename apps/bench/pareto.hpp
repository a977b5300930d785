#pragma once
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rill::bench {

/// Cost and error; what is not finite is never on a front.
using CostError = std::pair<double, double>;

/// Indices, by rising cost, of the points that no other point beats in both.
std::vector<size_t> paretoFront(std::span<const CostError> points);

/// The cost at `error` on the curve through `points`, a line between neighbors where both axes are logarithmic; NaN outside it.
double costAtError(std::span<const CostError> points, double error);

}  // namespace rill::bench
