// Fluid between a wall and a solid that closes in on it until no particle fits between: it is taken out in full, at a bounded speed.
#include <algorithm>
#include <cmath>

#include "fluid/rig.hpp"

namespace rill::test {
namespace closing_gap_test {

using ClosingGapTest = FluidTest;

/// Lone particles below a box that comes down at some speed, at several distances from its side: at some depth the shortest way out is
/// sideways.
class BoxThatComesDown : public ClosingGapTest {
 protected:
  BoxThatComesDown() {
    setWalls(t, {1, 1, 2});
    t.scene.gravity = {0, 0, 0};
    t.scene.solids = {slab({0, d, 0}, {0.5, 0.5, 2})};
    for (int k = 0; k < 5; ++k) t.x.push_back({0.5 - (0.033 + 0.05 * k) * d, 0.5 * d, (3 + 6 * k) * d});
  }

  void expectBoundedSpeed() {
    expectEqual(t, 12, 1e-4, 1e-4);
    forEachGather(t, 12, [&](Run& run) {
      const Snapshot s = run.snapshot();
      EXPECT_GT(std::ranges::count_if(s.x, [&](const glm::dvec3& x) { return x.x > 0.5 + 0.4 * d; }), 3) << "they are beside the box";
      EXPECT_LT(s.fastest(), 2 * speed) << "a push of half a spacing in a step is no speed";
    });
  }

  Trial t = trial();
  const double d = t.d(), speed = 80 * d;  // m/s
};

TEST_F(BoxThatComesDown, DrivenMatchesReference) {
  t.scene.solids[0].motion = {{0, {0, 0, 0}}, {0.01, {0, -0.01 * speed, 0}}};
  expectBoundedSpeed();
}

TEST_F(BoxThatComesDown, HeavyBodyMatchesReference) {
  t.scene.solids[0].body = Body{.density = 1e6, .velocity = {0, -speed, 0}};
  expectBoundedSpeed();
}

TEST_F(ClosingGapTest, SqueezesFluidOutAtABoundedSpeed) {
  Trial t = trial();
  t.scene.fluid = FluidSettings{.spacing = 0.002};
  t.scene.solver = SolverSettings{};
  const double d = t.d();
  setWalls(t, {16 * d, 16 * d, 12 * d});
  t.scene.solids = {slab({10 * d, 0, 2 * d}, {14 * d, 3 * d, 6 * d})};
  t.scene.solids[0].motion = {{0, {0, 0, 0}}, {0.15, {0, 0, -1.95 * d}}};
  addOutsideSolids(t, block({16, 8, 8}, d));
  t.step = 1.0 / 60;
  const double fall = std::sqrt(2 * 9.81 * 16 * d);
  auto run = start(t);
  for (int n = 0; n < 40; ++n) {
    run->advance(0.005);
    ASSERT_LT(run->snapshot().fastest(), 2 * fall) << 0.005 * (n + 1) << " s";
  }
}

}  // namespace closing_gap_test
}  // namespace rill::test
