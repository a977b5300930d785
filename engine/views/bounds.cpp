#include "views/bounds.hpp"

#include <cmath>

namespace rill {

Bounds fluidBounds(const Scene& scene, const ParticleSet& particles) {
  Bounds bounds;
  for (const Float3& p : particles.positions) {
    if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < 1e15f)) continue;
    const double at[3] = {particles.origin[0] + p.x, particles.origin[1] + p.y, particles.origin[2] + p.z};
    bounds.add(at, 0.5 * scene.fluid.spacing);
  }
  return bounds;
}

void solidBall(const Solid& solid, double center[3], double& radius) {
  radius = solid.sphere ? solid.sphere->radius : 0;
  double square = 0;
  for (int a = 0; a < 3; ++a) {
    if (solid.box) {
      center[a] = 0.5 * (solid.box->min[a] + solid.box->max[a]);
      square += 0.25 * (solid.box->max[a] - solid.box->min[a]) * (solid.box->max[a] - solid.box->min[a]);
    } else {
      center[a] = solid.sphere ? solid.sphere->center[a] : 0;
    }
  }
  if (solid.box) radius = std::sqrt(square);
}

void addSolids(Bounds& bounds, const Scene& scene) {
  for (const Solid& solid : scene.solids) {
    double center[3], radius = 0;
    solidBall(solid, center, radius);
    if (solid.motion.empty()) bounds.add(center, radius);
    for (const Keyframe& key : solid.motion) {
      const double moved[3] = {center[0] + key.translate[0], center[1] + key.translate[1], center[2] + key.translate[2]};
      bounds.add(moved, radius);
    }
  }
}

}  // namespace rill
