// Several fluids of one spacing: substeps against the reference.
#include <glm/geometric.hpp>

#include "fluid/mixture.hpp"

namespace rill::test {
namespace fluids_test {

constexpr double kFluidsOne = 2e-4, kFluidsTen = 1e-3, kFluidsAgeing = 0.1;  // spacings, as of one fluid

TEST_F(FluidsTest, MixturesMatchReference) {
  for (const std::vector<double>& densities : {std::vector{1000.0, 500.0}, {1.0, 10.0, 1000.0}, {800, 900, 1000, 1, 2, 3, 4, 5}}) {
    SCOPED_TRACE(densities.size());
    Trial t = mixture(densities);
    expectEqual(t, 1, kFluidsOne, kFluidsOne);
    expectEqual(t, 10, kFluidsTen, kFluidsTen, kFluidsAgeing);
  }
}

TEST_F(FluidsTest, EveryTermMatchesReference) {
  Trial t = mixture({1000, 700, 20});
  t.scene.fluids[0].viscosity = 20;
  t.scene.fluids[1].viscosity = 1;
  t.scene.fluid.tensile = 1;
  t.scene.fluid.vorticity = 0.3;
  t.scene.solver.relaxation.reset();
  t.scene.solver.warm_start.reset();
  t.scene.solver.artificial_viscosity = 0.3;
  t.scene.solver.iterations = 3;
  t.scene.domain->slip = false;
  t.stepwise = true;
  expectEqual(t, 1, kFluidsOne, kFluidsOne);
  expectEqual(t, 10, kFluidsTen, kFluidsTen, kFluidsAgeing);
}

/// Around a box on the floor.
Trial besideBox(const Solid& box) {
  Trial t = mixture({1000, 300, 30});
  t.scene.fluid.viscosity = box.slip ? 0 : 5;
  t.scene.solids = {box};
  const Trial all = t;
  t.x.clear(), t.v.clear(), t.fluids.clear();
  for (size_t i = 0; i < all.x.size(); ++i) {
    if (surfaceAt(box.shape, solidPose(box, 0), {all.x[i].x, all.x[i].y, all.x[i].z}).distance < 0.52 * t.d()) continue;
    t.x.push_back(all.x[i]);
    t.v.push_back(all.v[i]);
    t.fluids.push_back(all.fluids[i]);
  }
  return t;
}

TEST_F(FluidsTest, SolidsMatchReference) {
  for (const double viscosity : {0.0, 5.0}) {
    SCOPED_TRACE(viscosity);
    Solid box = slab({0.125, -0.1, 0.125}, {0.25, 0.19, 0.3});
    box.slip = viscosity == 0;
    const Trial t = besideBox(box);
    expectEqual(t, 1, kFluidsOne, kFluidsOne);
    expectEqual(t, 10, kFluidsTen, kFluidsTen, kFluidsAgeing);
  }
}

TEST_F(FluidsTest, FrictionAndRestitutionMatchReference) {
  Trial t = mixture({1000, 300, 30});
  t.scene.solids = {slab({0.1, 0, 0.1}, {0.9, 0.25, 0.9})};
  t.scene.solids[0].friction = 0.4;
  t.scene.solids[0].restitution = 0.5;
  t.x = block({7, 4, 7}, t.d(), {0.2, 0.26, 0.25}, 0.05);
  t.v.assign(t.x.size(), {1, -2, 0.5});
  t.fluids.resize(t.x.size());
  expectEqual(t, 1, kFluidsOne, kFluidsOne);
  // The reference takes what the bound on added speed removes out of friction; light particles come to it sooner.
  expectEqual(t, 10, 20 * kFluidsTen, 5 * kFluidsTen);
}

TEST_F(FluidsTest, LoadsMatchReference) {
  for (const bool slip : {true, false}) {
    SCOPED_TRACE(slip);
    Solid box = slab({0.125, -0.1, 0.125}, {0.25, 0.19, 0.3});
    box.slip = slip;
    Trial t = besideBox(box);
    t.loads = true;
    const std::vector<reference::Impulse> exact = Oracle(t).advanceWithLoads(10);
    forEachGather(t, 10, [&](Run& run) {
      const SolidLoad load = run.fluid().solidLoads()[0];
      EXPECT_LT(glm::length(reference::vec(load.impulse) - exact[0].linear), 0.01 * glm::length(exact[0].linear));
    });
  }
}

TEST_F(FluidsTest, BodiesMatchReference) {
  for (const bool slip : {true, false}) {
    SCOPED_TRACE(slip);
    Solid box = slab({0.125, 0.06, 0.125}, {0.25, 0.19, 0.3});
    box.slip = slip;
    box.body = Body{.density = 200};
    const Trial t = besideBox(box);
    expectEqual(t, 5, 2 * kFluidsTen, 2 * kFluidsTen, kFluidsAgeing);
    Oracle oracle(t);
    const std::vector<reference::Impulse> loads = oracle.advanceWithLoads(10);
    const reference::BodyMotion& exact = oracle.solver().bodies().motion(0);
    EXPECT_GT(glm::length(exact.velocity), 0.02) << "the trial does not move it";
    forEachGather(t, 10, [&](Run& run) {
      const BodyMotion found = run.fluid().bodies()[0];
      EXPECT_LT(glm::length(reference::vec(found.velocity) - exact.velocity) * t.step, 2 * kFluidsTen * t.d());
      EXPECT_LT(glm::length(reference::vec(found.angularVelocity) - exact.angularVelocity) * 0.1 * t.step, 2 * kFluidsTen * t.d());
      EXPECT_LT(glm::length(reference::vec(run.fluid().solidLoads()[0].impulse) - loads[0].linear), 0.01 * glm::length(loads[0].linear));
    });
  }
}

TEST_F(FluidsTest, InitialPressureMatchesReference) {
  Trial t = mixture({1000, 100});
  t.v.clear();
  t.x = block({6, 7, 6}, t.d());
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids[i] = t.x[i].y > 3.5 * t.d();
  setWalls(t, {6 * t.d(), 1, 6 * t.d()});
  t.settle = true;
  expectEqual(t, 3, kFluidsOne, kFluidsOne);
}

}  // namespace fluids_test
}  // namespace rill::test
