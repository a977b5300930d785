#pragma once
// From a scene's walls and solids to what the shaders read of them. Lengths relative to the particles' origin.
#include "fluid/settings.hpp"
#include "shape/mass.hpp"
#include "sph/kernel.hpp"

namespace rill {

/// Bounds the speed of every point of the solids that keyframes move, m/s.
double fastestSolid(const Scene& scene);
/// Bounds the initial speed of every point of the bodies, m/s.
double fastestBody(const Scene& scene);
/// m/s, of all solids that the host moves.
double fastestDriven(const Scene& scene);

/// The record of a solid's body at its start, among the scene's solids at `index`.
BodyRecord bodyRecord(const Solid& solid, const MassProperties& m, uint32_t index, const Double3& origin);

/// A power of two that is no shorter than the distance from a solid's center to a particle whose density it displaces, m.
double loadLever(const Scene& scene, double support);

/// The records of a scene's solids at time 0, their keyframes, the tables of its spheres and the fields of its meshes. TooLarge for a mesh
/// that is too large for the spacing.
Expected<void> addSolids(const Scene& scene, const SmoothingKernel& kernel, const Double3& origin, FluidSetup& setup);
/// Walls, the domain's bounds, and how near a center may come to them.
void setWalls(const Scene& scene, const Double3& origin, FluidParams& p);
/// The density that a half-space displaces, which boxes are made of.
void addHalfSpaceTable(const SmoothingKernel& kernel, FluidSetup& setup);
/// How strongly viscous fluid sticks to solids.
void addNoSlipTable(const SmoothingKernel& kernel, FluidSetup& setup);

}  // namespace rill
