#pragma once
#include <optional>

#include "rill/scene.hpp"

namespace rill {

inline constexpr double kWallSlack = 1e-4;  // spacings: rounding tolerance at walls and solids

inline bool isClosed(const Domain& domain, int side) { return (domain.open >> side & 1) == 0; }

/// Whether p (m, scene coordinates) is more than `slack` (m) outside a closed wall.
inline bool beyondWall(const std::optional<Domain>& domain, const Double3& p, double slack) {
  if (!domain) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < domain->min[axis] - slack && isClosed(*domain, 2 * axis)) return true;
    if (p[axis] > domain->max[axis] + slack && isClosed(*domain, 2 * axis + 1)) return true;
  }
  return false;
}

}  // namespace rill
