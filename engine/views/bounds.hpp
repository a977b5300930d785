#pragma once
#include <algorithm>
#include <limits>

#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

/// An axis-aligned box, m; empty until something is added.
struct Bounds {
  Double3 min = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Double3 max = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min[0] <= max[0]); }
  void add(const Double3& point, double reach = 0) {
    for (int a = 0; a < 3; ++a) {
      min[a] = std::min(min[a], point[a] - reach);
      max[a] = std::max(max[a], point[a] + reach);
    }
  }
};

/// The particles with half a spacing around each; empty without any. Particles that are not finite, or beyond 1e15 m, are left out.
Bounds fluidBounds(const Scene& scene, const ParticleSet& particles);
/// Adds the solids over all of their keyframes: bounding spheres, of a mesh that does not turn the box around it.
void addSolids(Bounds& bounds, const Scene& scene);

}  // namespace rill
