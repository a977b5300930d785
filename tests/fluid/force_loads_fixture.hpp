#pragma once
// What forces on the fluid do to solids and bodies, after the solve: on the device and of the reference.
#include <algorithm>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"

namespace rill::test {

class ForceLoadsTest : public FluidTest {
 protected:
  /// Impulses on solids and motions of bodies after some substeps, whose differences are at most `limit` of the largest impulse, or
  /// spacings a substep. Returns the least impulse over the largest.
  double expectReferenceMotion(const Trial& t, int substeps, double limit) {
    using reference::vec;
    constexpr double kLever = 0.2;  // m
    Oracle oracle(t);
    const auto sums = oracle.advanceWithLoads(substeps);
    const auto size = [](const auto& sum) { return glm::length(sum.linear); };
    const auto [least, most] = std::ranges::minmax(sums, {}, size);
    const double largest = size(most);
    EXPECT_GT(largest, 0);
    forEachGather(t, substeps, [&](Run& run) {
      ASSERT_EQ(run.fluid().solidLoads().size(), sums.size());
      for (size_t k = 0; k < sums.size(); ++k) {
        const SolidLoad& load = run.fluid().solidLoads()[k];
        EXPECT_LT(glm::length(vec(load.impulse) - sums[k].linear), limit * largest) << k;
        EXPECT_LT(glm::length(vec(load.angularImpulse) - sums[k].angular), limit * kLever * largest) << k;
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(load.force[a] * substeps * t.step, load.impulse[a], 1e-5 * largest) << "one advance";
      }
      for (const BodyMotion& m : run.fluid().bodies()) {
        const reference::BodyMotion& exact = oracle.solver().bodies().motion(m.solid);
        EXPECT_LT(glm::length(vec(m.velocity) - exact.velocity) * t.step, limit * t.d()) << m.solid;
        EXPECT_LT(glm::length(vec(m.angularVelocity) - exact.angularVelocity) * kLever * t.step, limit * t.d()) << m.solid;
      }
    });
    return size(least) / largest;
  }
};

}  // namespace rill::test
