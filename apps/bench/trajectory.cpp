#include "bench/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rill::bench {

Trajectory trajectoryOf(std::span<const apps::Instant> run, double length, double energy) {
  Trajectory trajectory;
  for (const apps::Instant& instant : run) {
    const offline::Stats& s = instant.stats;
    trajectory.at.push_back({s.centerOfMass[0] / length, s.centerOfMass[1] / length, s.centerOfMass[2] / length, s.front_m / length,
                             s.kinetic_J / energy, s.potential_J / energy});
  }
  return trajectory;
}

Trajectory meanTrajectory(std::span<const Trajectory> seeds) {
  Trajectory mean;
  if (seeds.empty()) return mean;
  size_t instants = seeds[0].at.size();
  for (const Trajectory& seed : seeds) instants = std::min(instants, seed.at.size());
  mean.at.resize(instants);
  for (size_t k = 0; k < instants; ++k)
    for (size_t q = 0; q < Trajectory::kQuantities; ++q) {
      mean.at[k][q] = 0;
      for (const Trajectory& seed : seeds) mean.at[k][q] += seed.at[k][q] / double(seeds.size());
    }
  return mean;
}

double rmsDistance(const Trajectory& a, const Trajectory& b) {
  const size_t instants = std::min(a.at.size(), b.at.size());
  if (instants == 0) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (size_t k = 0; k < instants; ++k)
    for (size_t q = 0; q < Trajectory::kQuantities; ++q) sum += (a.at[k][q] - b.at[k][q]) * (a.at[k][q] - b.at[k][q]);
  const double rms = std::sqrt(sum / double(instants * Trajectory::kQuantities));
  return std::isfinite(rms) ? rms : std::numeric_limits<double>::infinity();
}

}  // namespace rill::bench
