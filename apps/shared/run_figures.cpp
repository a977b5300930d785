#include "shared/run_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rill::apps {
namespace {

/// Mass of all fluid, kg.
double fluidMass(const Scene& scene, const offline::Stats& stats) {
  const double volume = std::pow(scene.fluid.spacing, 3);
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  if (fluids.size() == 1 || stats.fluids.size() != fluids.size()) return double(stats.particles) * fluids[0].density * volume;
  double mass = 0;
  for (size_t i = 0; i < fluids.size(); ++i) mass += double(stats.fluids[i].particles) * fluids[i].density * volume;
  return mass;
}

/// Potential energy of all fluid at the domain's lowest corner, J. Energies are measured from there, so that their ratio
/// does not depend on the scene's origin.
double lowestPotential(const Scene& scene, double mass) {
  if (!scene.domain) return 0;
  double least = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double g = scene.gravity[axis];
    least += std::min(-g * scene.domain->min[axis], -g * scene.domain->max[axis]);
  }
  return mass * least;
}

}  // namespace

EnergyFigures energyFigures(const Scene& scene, std::span<const Instant> run) {
  EnergyFigures energy;
  if (run.empty()) return energy;
  const auto total = [](const Instant& instant) { return instant.stats.kinetic_J + instant.stats.potential_J; };
  energy.start_J = energy.max_J = total(run.front());
  energy.end_J = total(run.back());
  for (const Instant& instant : run) energy.max_J = std::max(energy.max_J, total(instant));
  // Of the fluid that is there at each instant: what drains and open sides remove is above its lowest place, too.
  const auto above = [&](const Instant& instant) { return total(instant) - lowestPotential(scene, fluidMass(scene, instant.stats)); };
  const double start = above(run.front());
  const auto ratio = [&](const Instant& instant) {
    if (above(instant) == start) return 1.0;
    return start > 0 ? above(instant) / start : std::numeric_limits<double>::quiet_NaN();
  };
  energy.ratio = ratio(*std::ranges::max_element(run, {}, above));
  energy.end_ratio = ratio(run.back());
  return energy;
}

DensityFigures densityFigures(std::span<const Instant> run) {
  DensityFigures error;
  if (run.empty()) return error;
  const size_t skip = std::min((run.size() + 9) / 10, run.size() - 1);
  std::vector<double> medians;
  for (const Instant& instant : run.subspan(skip)) {
    error.mean += instant.stats.densityErrorMean / double(run.size() - skip);
    error.p99 = std::max(error.p99, instant.stats.densityErrorP99);
    error.max = std::max(error.max, instant.stats.densityErrorMax);
    medians.push_back(instant.stats.densitySignedMedian);
  }
  const auto middle = medians.begin() + static_cast<std::ptrdiff_t>(medians.size() / 2);
  std::nth_element(medians.begin(), middle, medians.end());
  error.signed_median = *middle;
  return error;
}

double wallSeconds(std::span<const Instant> run) {
  double sum = 0;
  for (const Instant& instant : run) sum += instant.stats.wall_s;
  return sum;
}

}  // namespace rill::apps
