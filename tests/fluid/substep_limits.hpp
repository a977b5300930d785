#pragma once
// Substeps of the device beside those of the reference: how far they may be apart, in spacings, and a fluid for them.
#include "fluid/rig.hpp"

namespace rill::test {
namespace substep_test {

using SubstepTest = FluidTest;

inline constexpr double kOne = 2e-4;    // after one substep
inline constexpr double kTen = 1e-3;    // after ten
inline constexpr double kAgeing = 0.1;  // of the list, more: see expectEqual()

/// Between walls, a block whose particles move at up to `fastest` (m/s) along each axis.
inline Trial agitated(double fastest, double jitter = 0.1) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, jitter);
  t.v = randomCloud(t.x.size(), 2 * fastest, 5, glm::dvec3(-fastest));
  return t;
}

}  // namespace substep_test
}  // namespace rill::test
