// Several fluids of one spacing: substeps against the reference, momentum, and that one fluid alone is what it was.
#include <algorithm>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"

namespace rill::test {
namespace fluids_test {

using FluidsTest = FluidTest;

constexpr double kFluidsOne = 2e-4, kFluidsTen = 1e-3, kFluidsAgeing = 0.1;  // spacings, as of one fluid

/// A jittered block in a corner, of fluids of these densities that are mixed at random.
Trial mixture(const std::vector<double>& densities, unsigned seed = 5) {
  Trial t = trial();
  for (const double density : densities) {
    const std::string name = "fluid " + std::to_string(t.scene.fluids.size());
    t.scene.fluids.push_back({.name = name, .density = density});
  }
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = cloud(t.x.size(), 0.4, seed, glm::dvec3(-0.2));
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(static_cast<uint8_t>((i * 7919 + seed) % densities.size()));
  return t;
}

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

// A block of two halves in free space.
TEST_F(FluidsTest, MomentumIsConserved) {
  for (const double lighter : {500.0, 1.0}) {
    SCOPED_TRACE(lighter);
    Trial t = trial();
    t.scene.gravity[1] = 0;
    t.scene.fluid.tensile = 1;
    t.scene.fluid.vorticity = 0;
    t.scene.fluid.viscosity = 3;
    t.scene.solver.artificial_viscosity.reset();
    t.scene.fluids = {{.name = "heavy", .density = 1000}, {.name = "light", .density = lighter}};
    // Compressed, but not so much that speeds are held back (docs/notes/overlaps.md), which acts on each particle alone.
    t.x = block({8, 8, 8}, (lighter > 100 ? 0.98 : 1.0) * t.d(), glm::dvec3(-4 * t.d()), lighter > 100 ? 0.03 : 0.001);
    t.v = cloud(t.x.size(), 0.2, 5, glm::dvec3(7.9, -6.1, 4.9));
    for (const glm::dvec3& x : t.x) t.fluids.push_back(x.x > 0);
    auto run = start(t);
    const auto momentum = [&] {
      const Snapshot s = run->snapshot();
      glm::dvec3 sum(0);
      double size = 0;
      for (size_t i = 0; i < s.v.size(); ++i) {
        const double mass = t.fluids[i] == 0 ? 1 : lighter / 1000;
        sum += mass * s.v[i];
        size += mass * glm::length(s.v[i]);
      }
      return std::pair(sum, size);
    };
    run->substeps(1);
    const auto [before, size] = momentum();
    run->substeps(10);
    EXPECT_LT(glm::length(momentum().first - before), 1e-4 * size);
    const FluidStats stats = run->stats();
    const double particle = 1000 * std::pow(t.d(), 3);
    EXPECT_NEAR(stats.momentum.x / particle, momentum().first.x, 1e-4 * size);
  }
}

// A flow between fluids is as fast as the difference of their densities makes it; what is slower is at rest.
TEST_F(FluidsTest, MotionFollowsTheDifferenceOfDensities) {
  const auto share = [&](const std::vector<double>& densities) {
    auto run = start(mixture(densities));
    run->substeps(1);
    run->snapshot();
    const FluidControl& c = run->control();
    const float found = implOf(run->fluid()).setup.params.motionShare;
    EXPECT_NEAR(c.restFraction, 1 - std::pow(std::min(c.flowSpeed / (found * std::sqrt(2 * c.head)), 1.0f), 4.0f), 1e-5);
    return found;
  };
  EXPECT_EQ(share({1000}), 0.5f);
  EXPECT_EQ(share({1000, 1000}), 0.5f) << "nothing drives a flow between them";
  EXPECT_NEAR(share({1000, 750, 1}), 0.25, 1e-6) << "the least difference";
  EXPECT_NEAR(share({1000, 999}), 0.2, 1e-6) << "not less than noise";
}

TEST_F(FluidsTest, EqualFluidsEqualOne) {  // but for the last bits of places
  Trial one = mixture({1000, 1000}), two = one;
  one.scene.fluids.clear();
  one.fluids.clear();
  auto a = start(one), b = start(two);
  a->substeps(10);
  b->substeps(10);
  const Snapshot left = a->snapshot(), right = b->snapshot();
  double most = 0;
  for (size_t i = 0; i < left.x.size(); ++i) most = std::max(most, glm::length(left.x[i] - right.x[i]) / one.d());
  EXPECT_LT(most, 1e-4);
}

TEST_F(FluidsTest, SnapshotGoesOnWithTheSameBits) {
  Trial t = mixture({1000, 400, 30});
  auto whole = start(t), first = start(t);
  first->substeps(12);
  const FluidSnapshot state = first->saved();
  EXPECT_EQ(state.fluid.size(), t.x.size());
  auto second = start(t, &state);
  whole->substeps(12);
  whole->substeps(12);
  second->substeps(12);
  EXPECT_EQ(firstDifference(whole->saved(), second->saved()), "");
  FluidSnapshot wrong = state;
  wrong.fluid[3] = 3;
  EXPECT_THROW(start(t, &wrong), std::runtime_error);
  wrong.fluid.clear();
  EXPECT_THROW(start(t, &wrong), std::runtime_error);
}

// Drains, an open side and an emitter, and a state that goes on from a checkpoint.
TEST_F(FluidsTest, LedgerOfEachFluidAddsUp) {
  Trial t = mixture({1000, 400, 30});
  t.scene.domain->open = 0b000010;
  t.scene.domain->open_removes = true;
  t.scene.drains = {{.shape = BoxShape{{0, 0, 0}, {0.15, 0.1, 0.4}}}};
  t.scene.emitters = {{.mouth = DiscMouth{{0.3, 0.8, 0.3}, 0.1, {0, -1, 0}}, .speed = 2, .fluid = "fluid 2"}};
  t.v.assign(t.x.size(), {6, 0, 0});
  t.capacity = 2000;
  auto first = start(t);
  for (int n = 0; n < 4; ++n) first->substeps(20);
  const FluidSnapshot state = first->saved();
  auto second = start(t, &state);
  for (int n = 0; n < 4; ++n) second->substeps(20);
  const FluidStats stats = second->stats();
  ASSERT_EQ(stats.fluids.size(), 3u);
  FluidLedger sum;
  for (const FluidFigures& f : stats.fluids) {
    EXPECT_EQ(f.ledger.filled + f.ledger.emitted, f.particles + f.ledger.drained + f.ledger.left + f.ledger.inactive);
    EXPECT_EQ(f.ledger.filled, t.x.size() / 3);
    sum.emitted += f.ledger.emitted, sum.drained += f.ledger.drained, sum.left += f.ledger.left;
  }
  EXPECT_EQ(sum.emitted, stats.ledger.emitted);
  EXPECT_EQ(sum.drained, stats.ledger.drained);
  EXPECT_EQ(sum.left, stats.ledger.left);
  EXPECT_GT(sum.drained, 0u);
  EXPECT_GT(sum.left, 0u);
  EXPECT_GT(stats.fluids[2].ledger.emitted, 0u);
  EXPECT_EQ(stats.fluids[0].ledger.emitted + stats.fluids[1].ledger.emitted, 0u);
}

TEST_F(FluidsTest, WithoutParticlesEachHasItsRow) {
  Trial t = mixture({1000, 400});
  t.x.clear(), t.v.clear(), t.fluids.clear();
  const FluidStats stats = start(t)->stats();
  ASSERT_EQ(stats.fluids.size(), 2u);
  EXPECT_EQ(stats.fluids[1].particles, 0u);
}

// Far from the origin the last bit of a place, which has the index, is 8 um.
TEST_F(FluidsTest, ParticlesInFreeFlightDoNotDrift) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  for (int k = 0; k < 8; ++k) {
    t.scene.fluids.push_back({.name = std::to_string(k)});
    t.x.push_back({k % 2 == 0 ? 64.3 : -64.3, -65.1 + k, 66.7});
    t.v.push_back({0.37, -0.213, 0.119});
    t.fluids.push_back(static_cast<uint8_t>(k));
  }
  Trial one = t;
  one.scene.fluids.clear();
  one.fluids.clear();
  auto several = start(t), alone = start(one);
  for (int n = 0; n < 10; ++n) several->substeps(100), alone->substeps(100);
  const Snapshot end = several->snapshot(), expected = alone->snapshot();
  for (size_t i = 0; i < end.x.size(); ++i) EXPECT_LT(glm::length(end.x[i] - expected.x[i]), 1e-3) << i;
}

TEST_F(FluidsTest, WarnsOfWhatItDoesNotDo) {
  Trial t = mixture({1000, 0.01});
  t.scene.solver.sleep = true;
  auto run = start(t);
  const auto warnings = run->fluid().warnings();
  EXPECT_EQ(std::ranges::count(warnings, "solver.sleep: has no effect in a scene with several fluids"), 1);
  const std::string ratio =
      "fluids.fluid 1.density: found 0.01 kg/m^3, 1e+05 times less than the densest fluid; expected at most 1000 times; ";
  EXPECT_EQ(std::ranges::count(warnings, ratio + "it is simulated with 1 kg/m^3"), 1);
  run->substeps(50);
  EXPECT_TRUE(run->snapshot().finite());

  t.scene.domain->slip = false;
  const std::string noSlip = "domain.slip: false has no effect: the viscosity of every fluid is 0, expected more (Pa s)";
  EXPECT_EQ(std::ranges::count(start(t)->fluid().warnings(), noSlip), 1);
  t.scene.fluids[1].viscosity = 1;
  EXPECT_EQ(std::ranges::count(start(t)->fluid().warnings(), noSlip), 0);
}

}  // namespace fluids_test
}  // namespace rill::test
