#include "bench/suites/surface_costs.hpp"

#include <algorithm>
#include <utility>

#include "bench/pareto.hpp"

namespace rill::bench {
namespace {

constexpr const char* kDefaultSettings = "default settings";

}  // namespace

void addCost(std::vector<SurfaceCost>& sums, const SurfaceVariant* variant, double ms, double mean, double p95) {
  auto found = std::ranges::find(sums, variant, &SurfaceCost::variant);
  if (found == sums.end()) found = sums.insert(sums.end(), SurfaceCost{variant});
  found->ms += ms;
  found->mean += mean;
  found->p95 += p95;
  ++found->count;
}

void tabulateCosts(const std::string& title, const std::string& what, const std::vector<SurfaceCost>& sums, const SurfaceVariant& first,
                   Report& report) {
  if (sums.empty()) return;
  std::vector<CostError> points;
  for (const SurfaceCost& sum : sums) points.emplace_back(sum.ms / sum.count, sum.mean / sum.count);
  const std::vector<size_t> front = paretoFront(points);
  Table table{title, {"method", "ms", "degrees", "p95 or worst frame", "Pareto front"}, {}, ""};
  for (size_t k = 0; k < sums.size(); ++k)
    table.rows.push_back({sums[k].variant->name(), number(points[k].first), number(points[k].second), number(sums[k].p95 / sums[k].count),
                          std::ranges::find(front, k) != front.end() ? "yes" : ""});
  report.tables.push_back(std::move(table));

  Plot plot{title, "ms", what, true, true, {}};
  plot.series.push_back({kDefaultSettings, Series::Style::Points, {}, {}, true});
  for (size_t k = 0; k < sums.size(); ++k) {
    const SurfaceVariant& variant = *sums[k].variant;
    const std::string name = variant.isDefault() ? kDefaultSettings : variant.family;
    auto found = std::ranges::find(plot.series, name, &Series::name);
    if (found == plot.series.end()) found = plot.series.insert(plot.series.end(), {name, Series::Style::Points, {}, {}});
    found->points.push_back(points[k]);
    found->labels.push_back(&variant == &first ? variant.family + " (default)" : variant.isDefault() ? variant.family : variant.setting);
  }
  Series line{"Pareto front", Series::Style::Lines, {}, {}};
  for (const size_t k : front) line.points.push_back(points[k]);
  plot.series.push_back(std::move(line));
  report.plots.push_back(std::move(plot));
}

}  // namespace rill::bench
