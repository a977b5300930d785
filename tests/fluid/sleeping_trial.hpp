#pragma once
// A room of fluid that may fall asleep.
#include "fluid/rig.hpp"

namespace rill::test {

/// In spacings of 0.02 m, filled from the floor in so many layers; steps of `step` s. The lattice is stable, so that it is at rest soon.
inline Trial sleepingTrial(glm::ivec3 room, int layers, double step) {
  Trial t = trial();
  t.scene.fluid.spacing = 0.02;
  t.scene.fluid.smoothing_ratio = 2;
  t.scene.solver = SolverSettings{};
  t.scene.solver.sleep = true;
  setWalls(t, glm::dvec3(room) * t.d());
  t.step = step;
  t.x = block({room.x, layers, room.z}, t.d());
  return t;
}

}  // namespace rill::test
