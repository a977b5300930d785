#pragma once
// Mass, center of mass and inertia of shapes with uniform density.
#include "shape/pose.hpp"
#include "shape/shape.hpp"

namespace rill {

struct MassProperties {
  double mass = 0;             ///< kg
  Double3 center = {0, 0, 0};  ///< of mass, in the shape's frame, m
  /// Tensor about the center of mass in the shape's frame, kg m^2: xx, yy, zz, yz, zx, xy.
  std::array<double, 6> inertia = {};
};

/// `density`: kg/m^3. The integrals over a mesh are those of the tetrahedra from its origin to its triangles (Eberly 2002).
MassProperties massOf(const Shape& shape, double density);

/// Of a solid with a body. `unit`: that of its shape with density 1.
MassProperties massOf(const Solid& solid, const MassProperties& unit);
MassProperties massOf(const Solid& solid);

/// The pose of a body's solid, from that of its center of mass. Both frames have the same axes.
Pose poseOfSolid(const Shape& shape, const Pose& centerOfMass);

/// Of the sphere around a point of the shape's frame that holds the shape, m.
double radiusAbout(const Shape& shape, const Double3& center);

}  // namespace rill
