// Merged passes, as on GPUs, give the same bits as separate ones, as on CPU drivers.
#include <algorithm>
#include <array>

#include "fluid/rig.hpp"

namespace rill::test {
namespace merged_passes_test {

Trial tank(glm::ivec3 count = {12, 9, 8}) {
  Trial t = trial();
  t.x = block(count, t.d(), glm::dvec3(0.06), 0.05);
  t.v = randomCloud(t.x.size(), 2, 3, glm::dvec3(-1));
  setWalls(t, glm::dvec3(count) * t.d() + glm::dvec3(0.25));
  t.settle = true;
  t.scene.solver.cfl = 0.25;
  return t;
}

class MergedPasses : public FluidTest {
 protected:
  /// Of a recorded block.
  static size_t passes(Run& run, std::string_view name) {
    Graph graph;
    run.fluid().addTo(graph, {.advance_s = 0.001, .substeps = 1});
    EXPECT_TRUE(graph.compile());
    return static_cast<size_t>(std::ranges::count(graph.report(), name, &PassReport::name));
  }

  /// A GPU's compiler may contract other products where a pass does more: NVIDIA's changes the last bit of a few multipliers.
  void expectSame(FluidSnapshot merged, const FluidSnapshot& separate) {
    if (!implOf(rillDevice()).isCpu && merged.warmStart.size() == separate.warmStart.size()) {
      for (size_t i = 0; i < merged.warmStart.size(); ++i)
        EXPECT_NEAR(merged.warmStart[i], separate.warmStart[i], 1e-6 * std::abs(separate.warmStart[i])) << i;
      merged.warmStart = separate.warmStart;
    }
    EXPECT_EQ(firstDifference(merged, separate), "");
  }

  /// After advances cut into pieces, of which some end within a block, and figures in between.
  void expectSameBits(Trial t) {
    for (const Gather gather : kGathers) {
      SCOPED_TRACE(nameOf(gather));
      t.gather = gather;
      std::array<FluidSnapshot, 2> states;
      std::array<double, 2> errors{};
      for (const bool merged : {false, true}) {
        t.mergePasses = merged;
        auto run = start(t);
        for (int k = 0; k < 3; ++k) {
          run->advance((5 + k) * t.step, k == 1 ? 1 : 64);
          errors[merged] += run->stats().densityErrorMean;
        }
        states[merged] = run->saved();
        EXPECT_NEAR(run->stats().time_s, 18 * t.step, 1e-6);
      }
      EXPECT_EQ(states[0].control, states[1].control);
      EXPECT_EQ(states[0].sums, states[1].sums);
      expectSame(states[0], states[1]);
      EXPECT_EQ(errors[0], errors[1]);
      EXPECT_GT(errors[0], 0);
    }
  }
};

TEST_F(MergedPasses, EqualSeparateOnesInATank) { expectSameBits(tank()); }

TEST_F(MergedPasses, EqualSeparateOnesWithIterations) {
  Trial t = tank();
  t.scene.solver.iterations = 4;
  t.scene.solver.tolerance = 0.003;  // some substeps converge before the last
  expectSameBits(t);
}

TEST_F(MergedPasses, EqualSeparateOnesWithSolidsAndForces) {
  Trial t = tank();
  t.scene.solids = {ball({0.3, 0.3, 0.3}, 0.1)};
  t.scene.fluid.viscosity = 0.05;
  t.scene.fluid.vorticity = 0.1;
  t.scene.fluid.drag = 0.1;
  expectSameBits(t);
}

TEST_F(MergedPasses, EqualSeparateOnesWhereListsOverflow) {
  Trial t = tank();
  for (size_t i = 0; i < 200; ++i) t.x[i] = t.x[0] + 0.3 * (t.x[i] - t.x[0]);
  t.settle = false;
  {
    auto run = start(t);
    run->substeps(1);
    EXPECT_GT(run->stats().neighborOverflow, 0u);
  }
  expectSameBits(t);
}

TEST_F(MergedPasses, EqualSeparateOnesWithRoomToSpare) {
  Trial t = tank();
  t.capacity = 9000;  // workgroups without particles take tickets, too
  expectSameBits(t);
}

// Of a fluid at rest noise damping is a start of its own.
TEST_F(MergedPasses, EqualSeparateOnesAtRest) {
  Trial t = tank();
  t.v.assign(t.x.size(), glm::dvec3(0));
  t.x = block({12, 9, 8}, t.d());
  setWalls(t, glm::dvec3(12, 20, 8) * t.d());
  t.scene.solver.artificial_viscosity = 0.01;
  expectSameBits(t);
}

TEST_F(MergedPasses, EqualSeparateOnesWithSeveralLists) {
  const SmallBuffers small(*this, uint64_t{8} << 20);
  Trial t = tank({14, 14, 14});
  t.scene.fluid.smoothing_ratio = 4;
  t.capacity = 16000;
  t.gather = Gather::Storage;
  std::array<FluidSnapshot, 2> states;
  for (const bool merged : {false, true}) {
    t.mergePasses = merged;
    auto run = start(t);
    EXPECT_EQ(implOf(run->fluid()).chunks().size(), 2u);
    run->substeps(3);
    states[merged] = run->saved();
    auto again = start(t);
    again->substeps(3);
    EXPECT_EQ(firstDifference(states[merged], again->saved()), "") << "the same passes, again";
  }
  expectSame(states[0], states[1]);
}

// One pass for the density and what follows from it.
TEST_F(MergedPasses, HaveNoControlPass) {
  for (const bool merged : {false, true}) {
    Trial t = tank();
    t.mergePasses = merged;
    auto run = start(t);
    const size_t densities = passes(*run, "density");
    EXPECT_GT(densities, 0u);
    EXPECT_EQ(passes(*run, "control"), merged ? 0u : densities);
  }
}

}  // namespace merged_passes_test
}  // namespace rill::test
