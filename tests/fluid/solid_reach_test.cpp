// What passes leave out because it seems out of reach: nothing that acts may be among it.
#include "fluid/bodies_fixture.hpp"

namespace rill::test {
namespace bodies_test {

class SolidReachTest : public BodiesTest {
 protected:
  /// Fluid that falls on a plate, from wall to wall: no center comes nearer to it than half a spacing. A substep moves a particle by up to
  /// two spacings, so the plate is three thick: what has not come to its middle is pushed back.
  void expectToStayAbove(const Solid& plate, double top) {
    Trial t = trial();
    t.scene.solver.cfl = 1;
    t.scene.solver.max_substeps = 64;
    t.step = 0.02;
    setWalls(t, {0.75, 3, 0.75});
    t.scene.solids = {plate};
    t.x = block({12, 16, 12}, t.d(), {0, top + 0.5 * t.d(), 0}, 0.05);
    t.v.assign(t.x.size(), {2, -15, 1});
    auto run = start(t);
    double lowest = 10, longest = 0;
    for (int n = 0; n < 40; ++n) {
      const Snapshot after = run->read({.advance_s = 1, .substeps = 1});
      ASSERT_EQ(after.x.size(), t.x.size());
      ASSERT_TRUE(after.finite());
      for (const glm::dvec3& x : after.x) lowest = std::min(lowest, x.y);
      longest = std::max(longest, double(run->control().step));
    }
    EXPECT_GT(lowest, top + 0.49 * t.d());
    EXPECT_LT(lowest, top + 0.6 * t.d()) << "none touched the plate";
    EXPECT_GT(longest * 15, 0.5 * t.d()) << "the substeps were too short to pass anything";
  }
};

TEST_F(SolidReachTest, FastFluidEndsOutsideAPlate) { expectToStayAbove(slab({-1, 1, -1}, {2, 1.1875, 2}), 1.1875); }

TEST_F(SolidReachTest, FastFluidEndsOutsideABodyThatIsAPlate) {
  Solid plate = body(slab({-1, 1, -1}, {2, 1.1875, 2}), 1000);
  plate.body->locked = 0b111111;
  expectToStayAbove(plate, 1.1875);
}

/// Ten small solids beside each other, near a wall: particles there have several in their lists, of which they feel some.
Trial cluster() {
  Trial t = trial();
  const double d = t.d();
  setWalls(t, {0.9, 1.2, 0.7});
  for (int k = 0; k < 10; ++k) {
    const glm::dvec3 at = glm::dvec3(1.5 * d, 0.2, 0.15) + glm::dvec3(2.4 * d * (k % 5), 0.3 * d * (k % 3), 2.6 * d * (k / 5));
    t.scene.solids.push_back(k % 2 == 0 ? ball(at, 0.9 * d) : slab(at - 0.8 * d, at + 0.8 * d));
  }
  addOutsideSolids(t, block({14, 10, 11}, d, {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {1, -1.5, 0.75});
  return t;
}

TEST_F(SolidReachTest, LoadsOfSolidsBesideEachOtherMatchReference) {
  Trial t = cluster();
  t.loads = true;
  expectEqual(t, 3, 2e-3, 2e-3);
  Oracle oracle(t);
  const auto sums = oracle.advanceWithLoads(3);
  forEachGather(t, 3, [&](Run& run) {
    for (size_t k = 0; k < sums.size(); ++k) {
      const SolidLoad& load = run.fluid().solidLoads()[k];
      const double size = glm::length(sums[k].linear);
      ASSERT_GT(size, 0) << k;
      EXPECT_LT(glm::length(vec(load.impulse) - sums[k].linear), 5e-3 * size) << k;
      EXPECT_LT(glm::length(vec(load.angularImpulse) - sums[k].angular), 5e-3 * t.d() * size) << k;
    }
  });
}

/// A ball between two heavier crates, without gravity: it touches one, then nothing, then the other.
TEST_F(SolidReachTest, ContactsThatVanishComeBack) {
  Trial t = trial();
  t.capacity = 1;
  t.scene.gravity[1] = 0;
  t.scene.solids = {body(ball({0, 0, 0}, 0.15), 800, {2, 0, 0}), crate({0.5, 0, 0}, 0.4, 6000), crate({-0.5, 0, 0}, 0.4, 6000)};
  t.scene.solids[0].restitution = 1;
  t.step = 2e-3;
  expectReferenceMotion(t, 240, 2e-2);
  auto run = start(t);
  int turns = 0;
  double before = 2;
  for (int n = 0; n < 60; ++n) {
    runFor(*run, 0.01);
    const double now = motion(*run, 0).velocity.x;
    turns += before * now < 0;
    before = now;
  }
  EXPECT_EQ(turns, 3);
}

}  // namespace bodies_test
}  // namespace rill::test
