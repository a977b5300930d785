#include <algorithm>
#include <cmath>

#include "bench/stability/stress_case.hpp"

namespace rill::bench {

Scene tankScene(double spacing, const Double3& fluid, const Double3& tank) {
  Scene scene = boxScene(spacing, {0, 0, 0}, tank);
  if (fluid[0] > 0) scene.fill.push_back(boxFill({0, 0, 0}, fluid));
  return scene;
}

ParticleSet particlesAt(std::vector<Float3> positions, const Float3& velocity) {
  ParticleSet set;
  set.velocities.assign(positions.size(), velocity);
  set.positions = std::move(positions);
  return set;
}

double speedBound(const Scene& scene, double start) {
  double head = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double maxGravity = std::abs(scene.gravity[axis]);
    for (const GravityChange& change : scene.gravity_changes) maxGravity = std::max(maxGravity, std::abs(change.value[axis]));
    const double room = scene.domain ? scene.domain->max[axis] - scene.domain->min[axis] : 1;
    head += maxGravity * room;
  }
  // Jets at walls reach two to three times the speed of the falling fluid.
  return 4 * std::sqrt(2 * head + start * start + 1e-12);
}

}  // namespace rill::bench
