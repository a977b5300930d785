#include "views/bounds.hpp"

#include <cmath>

#include "shape/shape.hpp"

namespace rill {

Bounds fluidBounds(const Scene& scene, const ParticleSet& particles) {
  Bounds bounds;
  for (const Float3& p : particles.positions) {
    if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < 1e15f)) continue;
    const Double3 at = {particles.origin[0] + p.x, particles.origin[1] + p.y, particles.origin[2] + p.z};
    bounds.add(at, 0.5 * scene.fluid.spacing);
  }
  return bounds;
}

void addSolids(Bounds& bounds, const Scene& scene) {
  for (const Solid& solid : scene.solids) {
    const Double3 center = centerOf(solid);
    const double radius = boundingRadius(solid.shape);
    if (solid.motion.empty()) bounds.add(center, radius);
    for (const Keyframe& key : solid.motion) {
      const Double3 moved = {center[0] + key.translate[0], center[1] + key.translate[1], center[2] + key.translate[2]};
      bounds.add(moved, radius);
    }
  }
}

}  // namespace rill
