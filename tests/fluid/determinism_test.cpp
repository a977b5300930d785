// The same bits however an advance is recorded, measured, or repeated: all that depends on the state is decided on the device.
#include <algorithm>

#include "fluid/rig.hpp"
#include "offline/readout.hpp"

namespace rill::test {
namespace determinism_test {

// A small dam break with a choice of its own steps: they depend on every particle, and lists are rebuilt at times that depend on the
// fastest.
Trial dam() {
  Trial t = trial();
  setWalls(t, {0.75, 0.75, 0.375});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 0.5, 9, {3, -0.25, -0.25});
  t.step = 1.0 / 60;
  t.scene.solver.cfl = 0.25;
  t.scene.solver.tolerance = 0.005;
  t.scene.fluid.tensile = FluidSettings{}.tensile;
  return t;
}

constexpr double kFrame = 1.0 / 60;

class DeterminismTest : public FluidTest {
 protected:
  Snapshot finish(const Trial& t, uint32_t piece, int frames = 4) {
    auto run = start(t);
    builds = 0;
    for (int n = 0; n < frames; ++n) {
      run->advance(kFrame, piece);
      builds += run->progress().listBuilds;
    }
    return run->snapshot();
  }
  uint32_t builds = 0;  // of all frames
};

TEST_F(DeterminismTest, RepeatedRunsAreEqual) {
  for (Gather gather : kGathers) {
    Trial t = dam();
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    const Snapshot once = finish(t, 64);
    ASSERT_TRUE(once.finite());
    EXPECT_EQ(once, finish(t, 64));
  }
}

// Particles of full lists walk the grid.
TEST_F(DeterminismTest, RepeatedRunsWithFullListsAreEqual) {
  Trial t = dam();
  t.settle = false;
  for (size_t i = 0; i < 150; ++i) t.x[i] = t.x[0] + 0.25 * (t.x[i] - t.x[0]);
  for (const bool merged : {false, true}) {
    SCOPED_TRACE(merged);
    t.mergePasses = merged;
    auto run = start(t), again = start(t);
    uint64_t overflow = 0;
    for (int n = 0; n < 6; ++n) {
      run->substeps(1);
      again->substeps(1);
      overflow += run->stats().neighborOverflow;
      (void)again->stats();
    }
    EXPECT_GT(overflow, 0u);
    EXPECT_EQ(firstDifference(run->saved(), again->saved()), "");
  }
}

TEST_F(DeterminismTest, RepeatedRunsWithForcesAreEqual) {
  Trial t = dam();
  t.scene.solver.iterations = 3;
  t.scene.fluid.viscosity = 5;
  t.scene.fluid.vorticity = 0.3;
  t.scene.fluid.surface_tension = 0.5;
  t.scene.fluid.tensile = 0.5;
  t.scene.solids = {ball({0.55, 0.15, 0.1875}, 0.1)};
  t.scene.solids[0].friction = 0.3;
  EXPECT_EQ(finish(t, 64, 2), finish(t, 12, 2));
}

TEST_F(DeterminismTest, DoesNotDependOnPieceSize) {
  const Trial t = dam();
  const Snapshot whole = finish(t, 256);
  EXPECT_GT(builds, 1u);
  for (uint32_t piece : {6u, 12u, 64u}) EXPECT_EQ(whole, finish(t, piece)) << piece;
}

TEST_F(DeterminismTest, DoesNotDependOnMeasuring) {
  const Trial t = dam();
  const Snapshot unseen = finish(t, 64);
  auto run = start(t);
  for (int n = 0; n < 4; ++n) {
    run->advance(kFrame);
    run->stats();
    run->snapshot();
    run->stats();
  }
  EXPECT_EQ(unseen, run->snapshot());
}

TEST_F(DeterminismTest, DoesNotDependOnMeasuringBeforeTheStart) {
  const Trial t = dam();
  const Snapshot unseen = finish(t, 64);
  auto run = start(t);
  run->stats();
  for (int n = 0; n < 4; ++n) run->advance(kFrame);
  EXPECT_EQ(unseen, run->snapshot());
}

// Figures asked for in the graph that advances, in the middle of an advance.
TEST_F(DeterminismTest, DoesNotDependOnMeasuringBetweenPieces) {
  const Trial t = dam();
  const Snapshot unseen = finish(t, 64, 1);
  auto run = start(t);
  bool resume = false;
  do {
    run->read({.advance_s = kFrame, .resume = resume, .substeps = 6, .stats = true});
    ASSERT_FALSE(HasFatalFailure());
    resume = true;
  } while (run->progress().timeLeft_s > 0);
  EXPECT_EQ(unseen, run->snapshot());
}

// Several advances in one command buffer: what the host knows between them changes nothing.
TEST_F(DeterminismTest, DoesNotDependOnRecordingAhead) {
  const Trial t = dam();
  const Snapshot waited = finish(t, 96);
  auto run = start(t);
  Graph graphs[4];
  std::vector<Graph*> all;
  for (Graph& graph : graphs) {
    run->fluid().addTo(graph, {.advance_s = kFrame, .substeps = 96});
    all.push_back(&graph);
  }
  runGraphs(all);
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_EQ(run->progress().timeLeft_s, 0) << "the frames were not recorded to their ends";
  EXPECT_NEAR(run->progress().time_s, 4 * kFrame, 1e-6);
  EXPECT_EQ(waited, run->snapshot());
}

// The order in which a scene lists its particles changes nothing but the ids: the sums differ in their order alone.
TEST_F(DeterminismTest, ParticleOrderChangesRoundingOnly) {
  Trial t = dam();
  t.step = 1e-3;
  t.scene.solver.cfl = 10;
  t.scene.solver.tolerance = 0;
  Trial turned = t;
  std::reverse(turned.x.begin(), turned.x.end());
  std::reverse(turned.v.begin(), turned.v.end());
  auto a = start(t), b = start(turned);
  a->substeps(5);
  b->substeps(5);
  const Snapshot one = a->snapshot(), other = b->snapshot();
  const size_t n = t.x.size();
  for (size_t i = 0; i < n; ++i)
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(one.x[i][axis], other.x[n - 1 - i][axis], 1e-4 * t.d()) << i;
}

}  // namespace determinism_test
}  // namespace rill::test
