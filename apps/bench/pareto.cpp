#include "bench/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rill::bench {

std::vector<size_t> paretoFront(std::span<const CostError> points) {
  std::vector<size_t> order(points.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::erase_if(order, [&](size_t k) { return !std::isfinite(points[k].first) || !std::isfinite(points[k].second); });
  std::ranges::sort(order, [&](size_t a, size_t b) { return points[a] < points[b]; });
  std::vector<size_t> front;
  double smallestError = std::numeric_limits<double>::infinity();
  for (const size_t k : order)
    if (points[k].second < smallestError) {
      smallestError = points[k].second;
      front.push_back(k);
    }
  return front;
}

double costAtError(std::span<const CostError> points, double error) {
  std::vector<CostError> sorted;
  for (const size_t k : paretoFront(points))
    if (points[k].first > 0 && points[k].second > 0) sorted.push_back(points[k]);
  for (size_t k = 1; k < sorted.size(); ++k) {
    const auto [costA, errorA] = sorted[k - 1];
    const auto [costB, errorB] = sorted[k];
    if (error > errorA || error < errorB) continue;
    const double t = std::log(error / errorA) / std::log(errorB / errorA);
    return costA * std::pow(costB / costA, t);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rill::bench
