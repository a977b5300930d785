#pragma once
// Where a body may touch others: small spheres that lie within its surface and touch it.
#include <vector>

#include "shape/shape.hpp"

namespace rill {

struct ContactPoint {
  Double3 center = {0, 0, 0};  ///< in the shape's frame, m
  double radius = 0;           ///< m, >= 0
};

/// Of a body, at most.
inline constexpr size_t kMaxContactPoints = 128;

/// A sphere has one, itself. A box has a grid on its surface, 3 to 5 along an edge, whose radius, a tenth of its smallest half extent,
/// rounds its edges: so a center stays outside of what the box touches, where the direction of the surface is safe. A mesh has points of
/// its surface, without a radius, each as far as possible from those before.
std::vector<ContactPoint> contactPoints(const Shape& shape);

}  // namespace rill
