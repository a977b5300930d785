// Viscosity that depends on shear: against the reference, momenta, and mud that stands.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "fluid/rig.hpp"

namespace rill::test {
namespace shear_viscosity_test {

using ShearViscosityTest = FluidTest;

/// A block with noise between walls that it sticks to, an isolated pair and a lone particle.
Trial mud(double yieldStress, double consistency, double flowIndex) {
  Trial t = trial();
  t.scene.fluid.yield_stress = yieldStress;
  t.scene.fluid.viscosity = consistency;
  t.scene.fluid.flow_index = flowIndex;
  setWalls(t, {1, 1, 1});
  t.scene.domain->slip = false;
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.x.insert(t.x.end(), {{0.9, 0.9, 0.9}, {0.7, 0.8, 0.2}, {0.76, 0.8, 0.2}});
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
  return t;
}

TEST_F(ShearViscosityTest, MatchesReference) {
  expectEqual(mud(0, 20, 0.5), 3, 1e-3, 1e-3);
  expectEqual(mud(0, 5, 1.5), 3, 1e-3, 1e-3);
  expectEqual(mud(300, 20, 1), 3, 1e-3, 1e-3);
  expectEqual(mud(300, 0, 1), 3, 2e-3, 2e-3);
}

TEST_F(ShearViscosityTest, FluidAtRestMatchesReference) {
  Trial t = mud(1e4, 20, 1);
  t.v.clear();
  expectEqual(t, 5, 2e-3, 2e-3);
}

TEST_F(ShearViscosityTest, CountsParticlesThatAskForMoreThanTheSolveReaches) {
  const auto capped = [&](double yieldStress) {
    const Trial t = mud(yieldStress, 20, 1);
    auto run = start(t);
    Oracle oracle(t);
    run->substeps(3);
    oracle.advance(3);
    EXPECT_EQ(run->stats().viscosityCapped, oracle.solver().viscosityCapped()) << yieldStress;
    return oracle.solver().viscosityCapped();
  };
  EXPECT_EQ(capped(1), 0u);
  const uint32_t some = capped(2e6);
  EXPECT_GT(some, 0u);
  EXPECT_GT(capped(1e9), some);
}

TEST_F(ShearViscosityTest, SolidsAndSeveralFluidsMatchReference) {
  Trial t = mud(300, 20, 0.8);
  t.scene.fluids = {{.name = "mud"},
                    {.name = "honey", .density = 1400, .viscosity = 10, .yield_stress = 0, .flow_index = 1},
                    {.name = "water", .density = 700, .viscosity = 0, .yield_stress = 0}};
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(static_cast<uint8_t>(i % 7 == 0 ? 2 : i % 2));
  Solid still = ball({0.5, 0.15, 0.2}, 0.1), body = ball({0.2, 0.55, 0.2}, 0.1);
  still.slip = body.slip = false;
  body.body = Body{.density = 500};
  t.scene.solids = {still, body};
  const std::vector<glm::dvec3> points = std::exchange(t.x, {});
  addOutsideSolids(t, points);
  t.v.resize(t.x.size());
  t.fluids.resize(t.x.size());
  t.loads = true;
  expectEqual(t, 3, 4e-3, 4e-3);
}

/// A ball of mud in free space that turns, squeezed so that it yields.
Trial turning(double yieldStress) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.fluid.yield_stress = yieldStress;
  t.scene.fluid.viscosity = 1;
  t.step = 4e-3;
  for (const glm::dvec3& x : block({9, 9, 9}, t.d(), glm::dvec3(-4.5 * t.d()), 0.05))
    if (glm::length(x) < 4.5 * t.d()) t.x.push_back(x);
  for (const glm::dvec3& x : t.x) t.v.push_back(glm::cross(glm::dvec3(0.3, 1, -0.5), x) + glm::dvec3(1 + x.x, 0.5 - x.y, 0));
  return t;
}

TEST_F(ShearViscosityTest, ConservesMomenta) {
  for (const double yieldStress : {10.0, 1e3, 1e5}) {
    auto run = start(turning(yieldStress));
    const auto momenta = [&] {
      const Snapshot s = run->snapshot();
      std::pair<glm::dvec3, glm::dvec3> sum(0, 0);
      for (size_t i = 0; i < s.x.size(); ++i) sum.first += s.v[i], sum.second += glm::cross(s.x[i], s.v[i]);
      return sum;
    };
    run->substeps(1);  // settles, which moves particles without time
    const auto before = momenta();
    for (int n = 0; n < 2; ++n) run->substeps(25);
    EXPECT_LT(glm::length(momenta().first - before.first), 1e-4 * glm::length(before.first)) << yieldStress;
    // The solve keeps it, the displacement after it does not: 1.7 and 3.0 % were found at 1 and 100 kPa.
    EXPECT_LT(glm::length(momenta().second - before.second), 0.05 * glm::length(before.second)) << yieldStress;
    EXPECT_EQ(run->stats().nonFinite, 0u) << yieldStress;
  }
}

TEST_F(ShearViscosityTest, FallsFreelyHoweverStiff) {
  Trial t = turning(1e8);
  t.scene.gravity[1] = -9.81;
  t.v.clear();
  for (glm::dvec3& x : t.x) x *= 1.1;  // under no pressure, whose forces need not sum to zero under gravity
  auto run = start(t);
  run->substeps(50);
  const glm::dvec3 mean = run->snapshot().velocitySum() / static_cast<double>(t.x.size());
  EXPECT_NEAR(mean.y, -9.81 * 50 * t.step, 1e-3 * 9.81 * 50 * t.step);
  EXPECT_LT(run->stats().kinetic_J, 1.001 * 0.5 * Oracle(t).solver().mass() * double(t.x.size()) * mean.y * mean.y);
}

TEST_F(ShearViscosityTest, StandsBelowItsYieldStress) {
  // A cube of 0.5 m: its floor bears rho g H = 4.9 kPa, so that it yields below about a third of that.
  const auto sinks = [&](double yieldStress) {
    Trial t = trial();
    t.scene.fluid.yield_stress = yieldStress;
    t.scene.fluid.viscosity = 100;
    setWalls(t, {2, 1, 2}, 0b111011);
    t.scene.domain->slip = false;
    t.x = block({8, 8, 8}, t.d(), {0.75, 0, 0.75});
    auto run = start(t);
    const auto height = [&] {
      double sum = 0;
      for (const glm::dvec3& x : run->snapshot().x) sum += x.y;
      return sum / static_cast<double>(t.x.size());
    };
    run->advance(0.2);
    const double before = height();
    for (int n = 0; n < 2; ++n) run->advance(0.1);
    return before - height();
  };
  EXPECT_LT(sinks(4000), 0.001);
  EXPECT_GT(sinks(200), 0.01);
}

TEST_F(ShearViscosityTest, HandlesDegenerateInput) {
  for (const double flowIndex : {0.2, 2.0})
    for (const double yieldStress : {0.0, 1e38}) {
      Trial t = mud(yieldStress, 1e6, flowIndex);
      t.x[40] = t.x[41];
      t.v[3] = {1e10, 0, 0};
      auto run = start(t);
      run->substeps(8);
      EXPECT_TRUE(run->snapshot().finite()) << flowIndex << " " << yieldStress;
    }
}

TEST_F(ShearViscosityTest, GoesOnFromASnapshotAsWithout) {
  const Trial t = mud(300, 20, 0.8);
  auto whole = start(t), first = start(t);
  whole->substeps(10);
  first->substeps(10);
  const FluidSnapshot middle = first->saved();
  auto second = start(t, &middle);
  second->substeps(10);
  whole->substeps(10);
  EXPECT_EQ(firstDifference(whole->saved(), second->saved()), "");
}

// An index of 1 without yield stress is the viscosity that it always was, and nothing of the others exists.
TEST_F(ShearViscosityTest, NewtonianFluidHasNoPassOfIt) {
  for (const double yieldStress : {0.0, 1.0}) {
    auto run = start(mud(yieldStress, 20, 1));
    run->substeps(2);
    const auto runs = run->fluid().passRuns();
    for (const char* name : {"viscosity by shear", "viscous displacement"})
      EXPECT_EQ(std::ranges::count(runs, name, &FluidPassRuns::name), yieldStress > 0 ? 1 : 0) << name;
  }
  Trial none = mud(0, 0, 0.5);
  none.scene.domain->slip = true;
  const auto setup = makeFluidSetup(none.timedScene(), {.capacity = 255, .extent = {1, 1, 1}});
  ASSERT_TRUE(setup);
  EXPECT_FALSE(setup->shearViscosity);
}

TEST_F(ShearViscosityTest, WarnsOfAFlowIndexWithoutViscosity) {
  Trial t = mud(0, 0, 0.5);
  const std::string own = ".flow_index: has no effect: its viscosity is 0, expected more (Pa s)";
  const std::string common = "fluid.flow_index: has no effect: the viscosity of every fluid that has it is 0, expected more (Pa s)";
  const auto expectWarnings = [&](const std::vector<std::string>& expected) {
    const auto setup = makeFluidSetup(t.timedScene(), {.capacity = 255, .extent = {1, 1, 1}});
    ASSERT_TRUE(setup);
    std::vector<std::string> found;
    for (const std::string& warning : setup->warnings)
      if (warning.find("flow_index") != std::string::npos) found.push_back(warning);
    EXPECT_EQ(found, expected);
  };
  expectWarnings({common});
  t.scene.fluids = {{.name = "water", .flow_index = 1}, {.name = "mud"}};
  expectWarnings({common});
  t.scene.fluids[0].flow_index = 0.8;
  expectWarnings({"fluids.water" + own, common});
  t.scene.fluids.push_back({.name = "honey", .viscosity = 1});
  expectWarnings({"fluids.water" + own});  // mud has the index for honey's sake
  t.scene.fluids[1].flow_index = 0.9;
  t.scene.fluids[2].flow_index = 0.9;
  expectWarnings({"fluids.water" + own, "fluids.mud" + own});
}

}  // namespace shear_viscosity_test
}  // namespace rill::test
