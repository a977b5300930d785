// The part of its own pressure that a particle with even neighbors does not feel, on the device beside the reference.
#include "shared/background_pressure.h"

#include <algorithm>

#include "fluid/substep_limits.hpp"

namespace rill::test {
namespace background_pressure_test {

using BackgroundPressureTest = FluidTest;

/// A nearly even block under pressure which moves.
Trial flowing() {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.x = block({8, 8, 8}, 0.97 * t.d(), {0.2, 0.2, 0.2}, 0.02);
  t.v.assign(t.x.size(), {0.7, 0.2, -0.5});
  return t;
}

/// The largest distance between particles of the two after some substeps of the reference, in spacings.
double largestDifference(const Trial& a, const Trial& b, int substeps) {
  Oracle one(a), other(b);
  one.advance(substeps);
  other.advance(substeps);
  double most = 0;
  for (size_t i = 0; i < a.x.size(); ++i)
    most = std::max(most, glm::length(one.solver().state.position[i] - other.solver().state.position[i]) / a.d());
  return most;
}

// With gravity too small to move anything the share is left out; without, all of the pressure acts.
TEST_F(BackgroundPressureTest, ShowsInTheTrial) {
  Trial some = flowing(), none = flowing();
  some.scene.gravity = {0, -1e-6, 0};
  none.scene.gravity = {0, 0, 0};
  EXPECT_GT(largestDifference(some, none, 10), 0.02);
}

TEST_F(BackgroundPressureTest, MatchesReference) {
  const Trial t = flowing();
  expectEqual(t, 1, substep_test::kOne, substep_test::kOne);
  expectEqual(t, 10, substep_test::kTen, substep_test::kTen, substep_test::kAgeing);
}

TEST_F(BackgroundPressureTest, OfFewNeighborsMatchesReference) {
  Trial t = flowing();
  t.scene.fluid.smoothing_ratio = 0.5 * (kTooFewNeighbors + kEnoughNeighbors);
  expectEqual(t, 10, substep_test::kTen, substep_test::kTen, substep_test::kAgeing);
}

TEST_F(BackgroundPressureTest, OfSeveralIterationsMatchesReference) {
  Trial t = flowing();
  t.scene.solver.iterations = 3;
  expectEqual(t, 10, substep_test::kTen, substep_test::kTen, substep_test::kAgeing);
}

// What walls and solids displace counts: beside them supports are as even as in fluid alone.
TEST_F(BackgroundPressureTest, BesideWallsAndSolidsMatchesReference) {
  for (const uint32_t iterations : {1u, 3u}) {
    Trial t = trial();
    setWalls(t, {0.5, 1, 0.5});
    t.scene.solids = {slab({0, 0, 0}, {0.5, 0.125, 0.5}), slab({0.2, 0.1, 0.1}, {0.33, 0.3, 0.3})};
    t.scene.solver.iterations = iterations;
    addOutsideSolids(t, block({8, 7, 8}, 0.98 * t.d(), {0, 0.125, 0}, 0.02));
    t.v.assign(t.x.size(), {0.1, -0.05, 0.2});
    expectEqual(t, 10, substep_test::kTen, substep_test::kTen, substep_test::kAgeing);
  }
}

TEST_F(BackgroundPressureTest, OfSeveralFluidsMatchesReference) {
  Trial t = flowing();
  t.scene.fluids = {{.name = "water", .density = 1000}, {.name = "oil", .density = 500}};
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(t.x[i].y > 0.45);
  expectEqual(t, 10, substep_test::kTen, substep_test::kTen, substep_test::kAgeing);
}

}  // namespace background_pressure_test
}  // namespace rill::test
