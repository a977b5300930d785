// What holds of several fluids without a reference: momentum, ledgers, checkpoints, and that equal fluids are one.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/mixture.hpp"

namespace rill::test {
namespace fluids_test {

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
    t.v = randomCloud(t.x.size(), 0.2, 5, glm::dvec3(7.9, -6.1, 4.9));
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
