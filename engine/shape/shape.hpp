#pragma once
// Geometry of the shapes of solids and fills. Points and directions are in the shape's frame: relative to its center, before its rotation.
// A further shape is an alternative of rill::Shape, an overload of each function here, and a lambda in each `Overloaded` that does not
// compile without. On the device it is a kind (shaders/shared/solid_records.h) and a branch where shaders take what is no sphere for a
// box: surfaceDistance and rayEntry in shared/shape.glsl, solidSample in fluid/solid_density.glsl, the rim in
// views/particle_shade_solids.comp.
#include <array>
#include <optional>

#include "rill/scene.hpp"

namespace rill {

/// Signed distance to a surface and its gradient.
struct SurfacePoint {
  double distance = 0;         ///< m, negative inside
  Double3 normal = {0, 1, 0};  ///< unit, outward
};

/// Center in the scene, m, before any motion.
Double3 centerOf(const BoxShape& box);
Double3 centerOf(const SphereShape& sphere);
Double3 centerOf(const MeshShape& mesh);
Double3 centerOf(const Shape& shape);

/// Center of a solid before any motion, scene coordinates, m.
Double3 centerOf(const Solid& solid);

/// Middle of the bounding box in the shape's own frame, m. Only that of a mesh is not 0.
Double3 middleOf(const Shape& shape);

/// Half extents of the bounding box in the shape's own frame, m.
Double3 halfExtents(const BoxShape& box);
Double3 halfExtents(const SphereShape& sphere);
Double3 halfExtents(const MeshShape& mesh);
Double3 halfExtents(const Shape& shape);

/// Radius of the sphere around the center that holds the shape, m.
double boundingRadius(const BoxShape& box);
double boundingRadius(const SphereShape& sphere);
double boundingRadius(const MeshShape& mesh);
double boundingRadius(const Shape& shape);

/// m^3.
double volumeOf(const BoxShape& box);
double volumeOf(const SphereShape& sphere);
double volumeOf(const MeshShape& mesh);

/// Half the thickness of a sheet, m, which surfaceAt() and rayEntry() leave out; 0 of other shapes. `spacing`: of the fluid, m.
double shellOf(const Shape& shape, double spacing);

/// The closest point of the surface. Box: edges are round outside; inside, ties take the first of x, y, z, and the positive side at 0.
/// Sphere: at the center the normal is +y. Mesh: exact; a sheet has no inside.
SurfacePoint surfaceAt(const BoxShape& box, const Double3& local);
SurfacePoint surfaceAt(const SphereShape& sphere, const Double3& local);
SurfacePoint surfaceAt(const MeshShape& mesh, const Double3& local);
SurfacePoint surfaceAt(const Shape& shape, const Double3& local);

/// Distance at which a ray (unit direction) enters the shape from outside, m, > 0; nullopt for a miss and from inside.
std::optional<double> rayEntry(const BoxShape& box, const Double3& from, const Double3& along);
std::optional<double> rayEntry(const SphereShape& sphere, const Double3& from, const Double3& along);
std::optional<double> rayEntry(const MeshShape& mesh, const Double3& from, const Double3& along);
std::optional<double> rayEntry(const Shape& shape, const Double3& from, const Double3& along);

/// Interval of a ray, in lengths of `along`, inside the box from `low` to `high`; empty where the first is larger.
std::array<double, 2> boxInterval(const Double3& low, const Double3& high, const Double3& from, const Double3& along);

/// Moves the solid in the scene, m.
void translate(Solid& solid, const Double3& by);

}  // namespace rill
