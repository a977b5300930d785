// A neighbor list too long for one buffer.
#include <glm/geometric.hpp>

#include "rig.hpp"

namespace rill::test {
namespace chunks_test {

using Chunks = FluidTest;

TEST_F(Chunks, TwoListChunksEqualTheGrid) {
  Trial t = trial();
  t.scene.fluid.smoothing_ratio = 3;
  t.x = block({32, 32, 32}, t.d(), glm::dvec3(0), 0.1);
  t.v.assign(t.x.size(), glm::dvec3(0));
  Snapshot listed, walked;
  {
    const SmallBuffers small(*this, uint64_t{8} << 20);
    const auto run = start(t);
    ASSERT_EQ(implOf(run->fluid()).chunks().size(), 2u);
    run->substeps(1);
    listed = run->snapshot();
  }
  t.scene.solver.neighbors = NeighborChoice::Grid;
  {
    const auto run = start(t);
    run->substeps(1);
    walked = run->snapshot();
  }
  ASSERT_EQ(listed.x.size(), walked.x.size());
  double worst = 0, moved = 0;
  for (size_t i = 0; i < listed.x.size(); ++i) {
    worst = std::max(worst, glm::length(listed.x[i] - walked.x[i]) / t.d());
    moved = std::max(moved, glm::length(listed.x[i] - t.x[i]) / t.d());
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(moved, 0.02) << "nothing to compare";
}

}  // namespace chunks_test
}  // namespace rill::test
