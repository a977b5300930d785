#pragma once
// Drops without gravity.
#include <cmath>
#include <numbers>

#include "bench/experiments/measures.hpp"
#include "rill/scene.hpp"

namespace rill::bench {

/// A scene without gravity and walls.
inline Scene weightless(double spacing_m, double density, double tension) {
  Scene scene;
  scene.fluid.spacing = spacing_m;
  scene.fluid.density = density;
  scene.fluid.surface_tension = tension;
  scene.gravity = {0, 0, 0};
  return scene;
}

/// Radius of a ball of as many particles, m.
inline double radiusOf(const Cloud& cloud) { return cloud.spacing * std::cbrt(0.75 * double(cloud.size()) / std::numbers::pi); }

/// Period of mode n of a drop, s (Rayleigh 1879).
inline double dropPeriod(int n, double radius_m, double density, double tension) {
  return 2 * std::numbers::pi * std::sqrt(density * std::pow(radius_m, 3) / (double(n * (n - 1) * (n + 2)) * tension));
}

}  // namespace rill::bench
