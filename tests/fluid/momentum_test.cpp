// Without walls, solids and gravity the forces of the solver are opposite in pairs: the sum of all velocities stays. Multipliers travel as
// halves, but both partners of a pair add the same two halves and the same gradient with the other sign. What is left is the rounding of
// each position, half an ulp, divided by the step.
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"

namespace rill::test {
namespace momentum_test {

class MomentumTest : public FluidTest {
 protected:
  static Trial drop() {
    Trial t = trial();
    t.scene.gravity[1] = 0;
    t.scene.solver.cfl = 10;  // the bound on the speed acts on each particle alone
    // Compressed, but not so much that speeds are held back (docs/notes/overlaps.md), which acts on each particle alone.
    t.x = block({7, 6, 7}, 0.98 * t.d(), glm::dvec3(-3.5 * t.d()), 0.03);
    t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
    for (glm::dvec3& v : t.v) v += glm::dvec3(8, -6, 5);
    return t;
  }
  void expectKept(Trial t, int substeps) {
    for (Gather gather : kGathers) {
      t.gather = gather;
      SCOPED_TRACE(nameOf(gather));
      auto run = start(t);
      const Snapshot before = run->snapshot();
      run->substeps(substeps);
      const Snapshot after = run->snapshot();
      ASSERT_TRUE(after.finite());
      double moved = 0, far = 0;
      for (size_t i = 0; i < after.x.size(); ++i) {
        moved = std::max(moved, glm::length(after.v[i] - before.v[i]));
        for (int a = 0; a < 3; ++a) far = std::max(far, std::abs(after.x[i][a]));
      }
      EXPECT_GT(moved, 0.1) << "nothing happened";
      // Roundings are random: their sum grows with the root of their number.
      const double ulp = std::exp2(std::ceil(std::log2(far)) - 24);
      const double limit = 2 * ulp / t.step * std::sqrt(double(after.x.size()) * substeps);
      for (int a = 0; a < 3; ++a) EXPECT_NEAR(after.velocitySum()[a], before.velocitySum()[a], limit) << a;
    }
  }
};

TEST_F(MomentumTest, IsConservedInOneSubstep) { expectKept(drop(), 1); }
TEST_F(MomentumTest, IsConservedInTenSubsteps) { expectKept(drop(), 10); }

TEST_F(MomentumTest, IsConservedInSeveralIterations) {
  Trial t = drop();
  t.scene.solver.iterations = 4;
  expectKept(t, 5);
}

TEST_F(MomentumTest, IsConservedWithTensileAndViscosity) {
  Trial t = drop();
  t.scene.fluid.tensile = 1;
  t.scene.fluid.viscosity = 20;
  expectKept(t, 5);
}

TEST_F(MomentumTest, IsConservedWithTheOtherKernel) {
  Trial t = drop();
  t.scene.solver.kernel = KernelChoice::Poly6Spiky;
  expectKept(t, 5);
}

}  // namespace momentum_test
}  // namespace rill::test
