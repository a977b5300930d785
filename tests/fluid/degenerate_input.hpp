#pragma once
// What tests of degenerate input share.
#include "fluid/rig.hpp"

namespace rill::test {
namespace degenerate_input_test {

using DegenerateInputTest = FluidTest;

// Beyond the walls of `t` by more than the rounding of a float.
inline size_t outsideOf(const Trial& t, const Snapshot& s) {
  const double slack = 1e-6;
  size_t count = 0;
  for (const glm::dvec3& x : s.x)
    for (int a = 0; a < 3; ++a) {
      const double high = t.scene.domain->max[a] - t.origin[a];
      if (!(x[a] >= -slack && x[a] <= high + slack)) ++count;
    }
  return count;
}

}  // namespace degenerate_input_test
}  // namespace rill::test
