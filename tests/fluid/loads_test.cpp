// Loads of the fluid on solids: against the reference, and against the change of the fluid's momentum.
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"
#include "shape/shape.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace loads_test {

using reference::vec;

/// Fluid under gravity around a box that is turned and a ball, both near walls.
Trial crowded() {
  Trial t = trial();
  setWalls(t, {0.9, 1.2, 0.7});
  Solid box = slab({0.05, 0.1, 0.1}, {0.35, 0.3, 0.4});
  box.rotation = {0, 0, std::sin(0.2), std::cos(0.2)};
  t.scene.solids = {box, ball({0.65, 0.3, 0.4}, 0.12)};
  t.loads = true;
  addOutsideSolids(t, block({14, 10, 11}, t.d(), {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {4, -6, 3});  // so fast that no gain is bounded, which acts on each particle alone
  return t;
}

class LoadsTest : public FluidTest {
 protected:
  /// After the first four substeps, on the first solid.
  Double3 firstImpulse(const Trial& t) {
    auto run = start(t);
    run->read({.advance_s = 100 * t.step, .substeps = 4});
    return run->fluid().solidLoads()[0].impulse;
  }
  /// Impulses since the start, on the device and of the reference.
  void expectReferenceLoads(const Trial& t, int substeps, double limit) {
    Oracle oracle(t);
    const auto sums = oracle.advanceWithLoads(substeps);
    double largest = 0;
    for (const auto& sum : sums) largest = std::max(largest, glm::length(sum.linear));
    ASSERT_GT(largest, 0);
    forEachGather(t, substeps, [&](Run& run) {
      ASSERT_EQ(run.fluid().solidLoads().size(), sums.size());
      for (size_t k = 0; k < sums.size(); ++k) {
        const SolidLoad& load = run.fluid().solidLoads()[k];
        const double size = std::max(glm::length(sums[k].linear), 0.01 * largest);
        EXPECT_LT(glm::length(vec(load.impulse) - sums[k].linear), limit * size) << k;
        EXPECT_LT(glm::length(vec(load.angularImpulse) - sums[k].angular), limit * (0.1 * size + glm::length(sums[k].angular))) << k;
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(load.force[a] * substeps * t.step, load.impulse[a], 1e-5 * size) << "one advance";
      }
    });
  }
};

TEST_F(LoadsTest, MatchReference) {
  expectReferenceLoads(crowded(), 3, 2e-3);
  expectReferenceLoads(crowded(), 10, 4e-2);  // particles differ by a hundredth of the spacing then
}

TEST_F(LoadsTest, ContactMatchesReference) {
  Trial t = crowded();
  for (Solid& solid : t.scene.solids) {
    solid.friction = 0.4;
    solid.restitution = 0.3;
  }
  expectReferenceLoads(t, 3, 2e-3);
  expectReferenceLoads(t, 10, 4e-2);
}

TEST_F(LoadsTest, OfATurningMeshMatchReference) {
  Trial t = crowded();
  t.x.clear();
  Solid& mesh = t.scene.solids[1];
  mesh = {.shape = MeshShape{.mesh = meshOf(ballMesh(0.12, 3))}, .translation = {0.65, 0.3, 0.4}};
  for (int k = 0; k <= 4; ++k) mesh.motion.push_back({0.1 * k, {0, 0.05 * k, 0}, {0, std::sin(0.2 * k), 0, std::cos(0.2 * k)}});
  addOutsideSolids(t, block({14, 10, 11}, t.d(), {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {1, -1.5, 0.75});  // faster fluid is pushed out of the mesh, along a direction that is known approximately
  expectReferenceLoads(t, 5, 5e-3);
}

// More than a particle lists, and than a workgroup looks at one by one.
TEST_F(LoadsTest, OfManySolidsMatchReference) {
  Trial t = crowded();
  t.x.clear();
  t.scene.solids.clear();
  for (int k = 0; k < 27; ++k)
    t.scene.solids.push_back(ball(glm::dvec3(0.25, 0.2, 0.2) + 0.07 * glm::dvec3(k % 3, k / 3 % 3, k / 9), 0.03));
  addOutsideSolids(t, block({14, 10, 11}, t.d(), {0, 0, 0}, 0.02));
  t.v.assign(t.x.size(), {4, -6, 3});
  expectReferenceLoads(t, 2, 2e-2);
}

TEST_F(LoadsTest, AreMeansOfAdvancesThatWereCutShort) {
  Trial t = crowded();
  t.scene.solver.max_substeps = 4;
  auto run = start(t);
  for (int n = 0; n < 2; ++n) run->read({.advance_s = 100 * t.step, .substeps = 4});
  const SolidLoad& load = run->fluid().solidLoads()[0];
  ASSERT_GT(glm::length(vec(load.impulse)), 0);
  EXPECT_NEAR(load.force.y * 4 * t.step, firstImpulse(t).y, 1e-4 * std::abs(load.impulse.y));
}

/// Fluid that meets two solids far from walls, without gravity.
Trial free() {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.loads = true;
  Solid box = slab({-0.2, -0.3, -0.25}, {0.2, -0.05, 0.2});
  box.rotation = {0.1, 0, std::sin(0.2), std::sqrt(1 - 0.01 - std::sin(0.2) * std::sin(0.2))};
  t.scene.solids = {box, ball({0.15, 0.2, 0.1}, 0.13)};
  addOutsideSolids(t, block({10, 12, 10}, 0.985 * t.d(), glm::dvec3(-0.3), 0.02));
  t.v.assign(t.x.size(), {8, -6, 5});
  return t;
}

TEST_F(LoadsTest, EqualTheChangeOfMomentum) {
  Trial t = free();
  for (int iterations : {1, 3}) {
    t.scene.solver.iterations = static_cast<uint32_t>(iterations);
    SCOPED_TRACE(iterations);
    auto run = start(t);
    const glm::dvec3 before = run->snapshot().velocitySum();
    run->substeps(10);
    const glm::dvec3 change = Oracle(t).solver().mass() * (run->snapshot().velocitySum() - before);
    glm::dvec3 reaction(0);
    for (const SolidLoad& load : run->fluid().solidLoads()) reaction += vec(load.impulse);
    EXPECT_GT(glm::length(change), 100) << "N s";
    // Where a solid pushed a prediction is known after the iterations alone, which turn the direction.
    EXPECT_LT(glm::length(change + reaction), (iterations == 1 ? 1e-5 : 1e-3) * glm::length(change));
  }
}

}  // namespace loads_test
}  // namespace rill::test
