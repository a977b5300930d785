// Surface tension of sph/surface_tension.hpp: v += dt F / m, F = -grad E.
#include "sph/surface_tension.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "reference/neighbors.hpp"
#include "reference/solver.hpp"

namespace rill::reference {
namespace {

/// A wall, or the tangent plane of a solid.
struct Plane {
  glm::dvec3 normal;  ///< away from it
  double distance;    ///< of the particle, m
  size_t solid = kWall;
  static constexpr size_t kWall = std::numeric_limits<size_t>::max();
};

double squareOf(const glm::dvec3& v) { return glm::dot(v, v); }

}  // namespace

double ReferenceSolver::tensionOf(size_t i) const {
  return settings.fluids.empty() ? settings.surfaceTension : settings.fluids[state.fluid[i]].surfaceTension;
}

double ReferenceSolver::coverOf(size_t i, size_t j) const {
  return settings.fluids.empty() ? 1 : settings.cover[state.fluid[i]][state.fluid[j]];
}

std::vector<ReferenceSolver::SurfaceSample> ReferenceSolver::surfaceSamples() const {
  const double d = settings.spacing, radius = double{kTensionRadius} * d, support = double{kTensionSupport} * d;
  const auto directions = tensionDirections();
  const Neighbors near = findNeighbors(state.position, radius + support);
  const std::vector<Pose> solids = poses(time_, 0);
  std::vector<SurfaceSample> samples;
  for (uint32_t i = 0; i < size(); ++i) {
    const glm::dvec3 x = state.position[i];
    std::vector<Plane> planes;
    for (int a = 0; a < 3; ++a)
      for (const bool high : {false, true}) {
        if (walls_.isOutflow(a, high, x)) continue;
        glm::dvec3 normal(0);
        normal[a] = high ? -1 : 1;
        planes.push_back({normal, high ? settings.hi[a] - x[a] : x[a] - settings.lo[a]});
      }
    Plane nearest{{0, 1, 0}, std::numeric_limits<double>::infinity()};
    for (size_t n = 0; n < solids.size(); ++n)
      if (const SurfacePoint point = surfaceOf(n, solids[n], x); point.distance < nearest.distance)
        nearest = {vec(point.normal), point.distance, n};
    planes.push_back(nearest);
    for (const Double3& direction : directions) {
      const glm::dvec3 offset = radius * vec(direction);
      double covered = 0;
      for (const uint32_t j : near.of(i)) {
        const double nearness = std::max(0.0, 1 - squareOf(x + offset - state.position[j]) / (support * support));
        covered += coverOf(i, j) * double{kTensionAmplitude} * nearness * nearness * nearness;
      }
      if (covered >= 1) continue;
      const auto away = [&](const Plane& plane) { return plane.distance + glm::dot(plane.normal, offset); };
      const Plane plane = std::ranges::min(planes, {}, away);
      const TensionWeight weight = tensionWeight(away(plane) / d, settings.wettingCosine);
      samples.push_back({i, offset, 1 - covered, weight.value, weight.slope * plane.normal, plane.solid});
    }
  }
  return samples;
}

void ReferenceSolver::surfaceTension(double dt) {
  const double d = settings.spacing, support = double{kTensionSupport} * d;
  const Neighbors near = findNeighbors(state.position, double{kTensionReach} * d);
  const std::vector<Pose> solids = poses(time_, 0);
  std::vector<Impulse> reactions(solids.size());
  const AddReaction add = addTo(reactions, solids, dt);
  for (const SurfaceSample& sample : surfaceSamples()) {
    const TensionRates rates = tensionRates(tensionOf(sample.particle), settings.density, d);
    glm::dvec3 own = -rates.wall * sample.open * sample.open * sample.weightSlope;
    if (sample.solid != Plane::kWall) add(sample.solid, own, state.position[sample.particle] + sample.offset);
    for (const uint32_t j : near.of(sample.particle)) {
      const glm::dvec3 apart = state.position[sample.particle] + sample.offset - state.position[j];
      const double nearness = std::max(0.0, 1 - squareOf(apart) / (support * support));
      const glm::dvec3 pull = coverOf(sample.particle, j) * rates.rate * sample.weight * sample.open * nearness * nearness * apart;
      own -= pull;
      state.velocity[j] += dt * inverseMass(j) * pull;
    }
    state.velocity[sample.particle] += dt * inverseMass(sample.particle) * own;
  }
  impulses_.resize(solids.size());
  for (size_t n = 0; n < solids.size(); ++n) {
    impulses_[n].linear += reactions[n].linear;
    impulses_[n].angular += reactions[n].angular;
  }
  bodies_.accelerate(reactions);
}

double ReferenceSolver::surfaceEnergy() const {
  const double d = settings.spacing;
  double energy = 0;
  for (const SurfaceSample& sample : surfaceSamples())
    energy += tensionRates(tensionOf(sample.particle), settings.density, d).wall * mass() * d * sample.weight * sample.open * sample.open;
  return energy;
}

}  // namespace rill::reference
