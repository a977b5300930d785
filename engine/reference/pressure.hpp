#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "sph/kernel.hpp"

namespace rill::reference {

/// Pressure of a fluid at a point (Pa, >= 0), as probes measure it: docs/notes/pressure.md.
/// `places` (m) and `multipliers` (m^2, <= 0) of its particles, after a solve for a substep of `dt` (s); `density`: kg/m^3.
double pressureAt(const glm::dvec3& x, std::span<const glm::dvec3> places, std::span<const double> multipliers,
                  const SmoothingKernel& kernel, double density, double dt);

}  // namespace rill::reference
