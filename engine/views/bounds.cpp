#include "views/bounds.hpp"

#include <cmath>

#include "shape/pose.hpp"
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

namespace {

bool turns(const Solid& solid) {
  return std::ranges::any_of(solid.motion, [&](const Keyframe& key) { return key.rotate != solid.motion.front().rotate; });
}

}  // namespace

void addSolids(Bounds& bounds, const Scene& scene) {
  for (const Solid& solid : scene.solids) {
    // The origin of a mesh may be far from it.
    const bool mesh = std::holds_alternative<MeshShape>(solid.shape) && !turns(solid);
    const double shell = shellOf(solid.shape, scene.fluid.spacing), radius = boundingRadius(solid.shape) + shell;
    const auto add = [&](const Pose& pose) {
      if (!mesh) return bounds.add(pose.center, radius);
      const SceneBox box = sceneBox(solid.shape, pose);
      bounds.add(box.low, shell);
      bounds.add(box.high, shell);
    };
    if (solid.motion.empty()) add(solidPose(solid, 0));
    for (const Keyframe& key : solid.motion) add(solidPose(solid, key.at));
  }
}

}  // namespace rill
