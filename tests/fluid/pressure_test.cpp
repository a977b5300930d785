// Pressure at probes: against the reference, against hydrostatics, and at places without fluid.
#include "reference/pressure.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "fluid/rig.hpp"

namespace rill::test {
namespace pressure_test {

using reference::vec;

void addProbes(Trial& t, std::initializer_list<glm::dvec3> places) {
  for (const glm::dvec3& at : places)
    t.scene.probes.push_back({.name = "probe " + std::to_string(t.scene.probes.size()), .pressure = Double3{at.x, at.y, at.z}});
}

/// Fluid under gravity in a tank, around a ball, with probes inside it, at a wall, in a corner and above.
Trial tank(uint32_t iterations = 1) {
  Trial t = trial();
  setWalls(t, {0.8, 1.2, 0.7});
  t.scene.solver.iterations = iterations;
  t.scene.solids = {ball({0.5, 0.3, 0.4}, 0.12)};
  addOutsideSolids(t, block({12, 9, 11}, t.d(), {0, 0, 0}, 0.05));
  addProbes(t, {{0.2, 0.2, 0.2}, {0, 0.1, 0.3}, {0, 0, 0}, {0.3, 0.55, 0.3}, {0.3, 0.9, 0.3}, {0.5, 0.3, 0.4}, {40, -3, 1e38}});
  addProbes(t, {{0.6, 0.1, 0.1}, {0.4, 0.12, 0.5}, {0.02, 0.3, 0.03}, {0.5, 0.13, 0.4}, {0.1, 0.4, 0.4}});
  return t;
}

class PressureTest : public FluidTest {
 protected:
  std::vector<PressureReading> readings(Run& run) {
    const auto all = run.fluid().pressures();
    return {all.begin(), all.end()};
  }

  /// Each probe's integral within `limit` of its own in the reference, where `wet` probes have one above 0.
  void expectReferencePressures(const Trial& t, int substeps, double limit, ptrdiff_t wet) {
    Oracle oracle(t);
    const auto& probes = t.scene.probes;
    std::vector<double> now(probes.size()), integral(probes.size());
    auto& solver = oracle.solver();
    solver.onStage = [&](reference::Stage stage) {
      for (size_t k = 0; k < probes.size(); ++k) {
        if (stage == reference::Stage::Multipliers)  // the last iteration's counts
          now[k] = reference::pressureAt(vec(*probes[k].pressure), solver.state.predicted, solver.lambda(), solver.kernel(),
                                         t.scene.fluid.density, t.step);
        if (stage == reference::Stage::Velocities) integral[k] += now[k] * t.step;
      }
    };
    oracle.advance(substeps);
    constexpr double kFloor = 1e-5;  // of the largest integral: rounding where pressures cancel
    const double largest = *std::ranges::max_element(integral);
    EXPECT_EQ(std::ranges::count_if(integral, [&](double x) { return x > 1e-2 * largest; }), wet);
    forEachGather(t, substeps, [&](Run& run) {
      const auto found = readings(run);
      ASSERT_EQ(found.size(), probes.size());
      for (size_t k = 0; k < probes.size(); ++k) {
        EXPECT_EQ(found[k].covered, k == 5) << k;
        if (found[k].covered) continue;
        EXPECT_NEAR(found[k].integral, integral[k], limit * integral[k] + kFloor * largest) << k;
        EXPECT_NEAR(found[k].mean * substeps * t.step, found[k].integral, 1e-5 * largest) << "one advance";
      }
    });
  }
};

TEST_F(PressureTest, MatchesReference) { expectReferencePressures(tank(), 10, 2e-3, 7); }
TEST_F(PressureTest, MatchesReferenceWithIterations) { expectReferencePressures(tank(3), 10, 2e-3, 8); }

TEST_F(PressureTest, MatchesReferenceWithoutWarmStart) {
  Trial t = tank();
  t.scene.solver.warm_start = 0;
  expectReferencePressures(t, 10, 2e-3, 7);
}

/// Four groups of particles, most at a distance of 5 mm, `together` of them at each place.
Trial groups(int together) {
  Trial t = tank();
  t.scene.solids.clear();
  t.x.clear();
  for (int k = 0; k < 12; ++k) {
    const double along = 0.005 * (k / together * together);
    t.x.push_back({0.2 + along, 0.2, 0.2});
    t.x.push_back({0.01, 0.12 + along, 0.3});
    t.x.push_back({0.05, 0.02, 0.03 + along});
  }
  for (int k = 0; k < 40; ++k) t.x.push_back({0.3 + 0.001 * k, 0.55, 0.3});
  t.scene.probes.resize(5);
  return t;
}

TEST_F(PressureTest, MatchesReferenceForFewParticles) { expectReferencePressures(groups(1), 1, 2e-3, 4); }

// Solver and reference differ in the gradients of coincident particles.
TEST_F(PressureTest, MatchesReferenceForCoincidentParticles) { expectReferencePressures(groups(2), 1, 0.04, 4); }

// Also at walls, where particles are on one side only; where they scatter: means of sixteen.
TEST_F(PressureTest, IsHydrostaticInFluidAtRest) {
  Trial t = trial();
  t.settle = true;
  setWalls(t, {0.75, 1.5, 0.75});
  t.x = block({12, 16, 12}, t.d());
  const double depth = 16 * t.d(), weight = t.scene.fluid.density * 9.81;
  addProbes(t, {{0.375, 0.5, 0.375}, {0.375, 1.2, 0.375}, {0.375, depth + 0.01, 0.375}});
  for (int k = 0; k < 16; ++k) {
    const double u = 0.15 * (1 + k % 4), v = 0.15 * (1 + k / 4);
    addProbes(t, {{u, 0, v}, {0, v, u}});
  }
  t.scene.solver.time_step = {};
  auto run = start(t);
  run->advance(1.5);
  run->advance(0.5);
  const auto found = readings(*run);
  EXPECT_NEAR(found[0].mean, weight * (depth - 0.5), 0.05 * weight * depth);
  EXPECT_EQ(found[1].mean, 0) << "in air";
  EXPECT_LT(found[2].mean, weight * t.d()) << "just above the surface";
  double floor = 0, wall = 0, wallDepth = 0;
  for (size_t k = 0; k < 16; ++k) {
    floor += found[3 + 2 * k].mean / 16;
    wall += found[4 + 2 * k].mean / 16;
    wallDepth += (depth - 0.15 * double(1 + k / 4)) / 16;
  }
  EXPECT_NEAR(floor, weight * depth, 0.1 * weight * depth);
  EXPECT_NEAR(wall, weight * wallDepth, 0.05 * weight * depth);
}

TEST_F(PressureTest, ContinuesFromSnapshotWithSameBits) {
  const Trial t = tank();
  auto run = start(t);
  run->substeps(7);
  const FluidSnapshot saved = run->saved();
  auto other = start(t, &saved);
  for (size_t k = 0; k < t.scene.probes.size(); ++k) EXPECT_EQ(readings(*run)[k].mean, other->fluid().pressures()[k].mean) << k;
  run->substeps(5);
  other->substeps(5);
  for (size_t k = 0; k < t.scene.probes.size(); ++k) {
    EXPECT_EQ(readings(*run)[k].mean, readings(*other)[k].mean) << k;
    EXPECT_EQ(readings(*run)[k].integral, readings(*other)[k].integral) << k;
  }
  EXPECT_GT(readings(*run)[0].mean, 0);
}

TEST_F(PressureTest, IgnoresReadingsOfOtherProbesInSnapshot) {
  Trial t = tank();
  auto run = start(t);
  run->substeps(3);
  const FluidSnapshot saved = run->saved();
  t.scene.probes.clear();
  addProbes(t, {{0.3, 0.2, 0.2}});
  auto other = start(t, &saved);
  EXPECT_EQ(other->fluid().pressures()[0].mean, 0);
  FluidSnapshot cut = saved;
  cut.pressures.pop_back();
  const Scene scene = t.timedScene();
  const ParticleSet particles = t.particles();
  const auto refused = Fluid::create(rillDevice(), {.scene = &scene, .particles = &particles, .snapshot = &cut});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("pressures has"), std::string::npos) << refused.error().message;
}

TEST_F(PressureTest, CostsNoPassAndChangesNoBit) {
  const auto substepped = [&](const Trial& t, bool& hasPass) {
    auto run = start(t);
    run->substeps(6);
    hasPass = false;
    for (const FluidPassRuns& pass : run->fluid().passRuns()) hasPass |= pass.name == "pressure at probes";
    return run->snapshot();
  };
  Trial t = tank();
  bool probed = false, plain = false;
  const Snapshot with = substepped(t, probed);
  t.scene.probes.clear();
  EXPECT_EQ(substepped(t, plain), with);
  EXPECT_TRUE(probed);
  EXPECT_FALSE(plain);
}

}  // namespace pressure_test
}  // namespace rill::test
