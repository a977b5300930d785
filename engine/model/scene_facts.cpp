#include "model/scene_facts.hpp"

#include <algorithm>
#include <cmath>

#include "core/vector_math.hpp"

namespace rill {

double strongestGravity(const Scene& scene) {
  double most = length(scene.gravity);
  for (const GravityChange& change : scene.gravity_changes) most = std::max(most, length(change.value));
  return most;
}

double strongestGravity(const Scene& scene, int axis) {
  double most = std::abs(scene.gravity[axis]);
  for (const GravityChange& change : scene.gravity_changes) most = std::max(most, std::abs(change.value[axis]));
  return most;
}

bool maySleep(const Scene& scene) { return scene.solver.sleep && scene.fluids.size() < 2 && strongestGravity(scene) > 0; }

}  // namespace rill
