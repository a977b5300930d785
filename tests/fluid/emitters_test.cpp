// Emitters: where and when particles leave their mouths, how many, and what blocks them.
#include <algorithm>
#include <numbers>

#include "fluid/flows_fixture.hpp"

namespace rill::test {
namespace flows_test {

TEST_F(FlowsTest, LatticeHasTheMouthsAreaAndRestDensity) {
  constexpr double d = 0.1;
  for (const Mouth& mouth : {Mouth(DiscMouth{{1, 2, 3}, 0.37, {1, -2, 0.5}}), Mouth(DiscMouth{{0, 0, 0}, 0.01, {0, 1, 0}}),
                             Mouth(RectMouth{{0, 1, 0}, {0.73, 0.28}, {0, 0, -2}, {1, 1, 0}}), Mouth(DiscMouth{{0, 0, 0}, 2, {0, 0, 1}})}) {
    const MouthLattice lattice = mouthLattice(mouth, d);
    const auto* disc = std::get_if<DiscMouth>(&mouth);
    const double area = disc ? std::numbers::pi * disc->radius * disc->radius : 0.73 * 0.28;
    EXPECT_NEAR(static_cast<double>(lattice.points.size()) * d * d * d, area * lattice.thickness, 1e-12);
    for (const Double3& axis : {lattice.normal, lattice.across, lattice.up}) EXPECT_NEAR(glm::length(vec(axis)), 1, 1e-12);
    EXPECT_NEAR(glm::dot(glm::cross(vec(lattice.normal), vec(lattice.up)), vec(lattice.across)), 1, 1e-12);
    double nearest = 1e9;
    for (const auto& [x, y] : lattice.points) {
      if (disc && lattice.points.size() > 1) { EXPECT_LT(std::hypot(x, y), 1.1 * disc->radius); }
      for (const auto& [u, v] : lattice.points)
        if (x != u || y != v) nearest = std::min<double>(nearest, std::hypot(x - u, y - v));
    }
    EXPECT_GT(nearest, 0.85 * d);
  }
}

TEST_F(FlowsTest, ParticlesLeaveAtTheirOwnTimes) {
  Trial t = space();
  t.scene.emitters = {disc({0.1, 0.2, 0.3}, 0.15, {1, 2, -0.5}, 1.5)};
  expectBirthsInEveryWay(t);
}

TEST_F(FlowsTest, ParticlesFallFromTheirOwnTimes) {
  Trial t = space();
  t.scene.gravity = {0, -9.81, 0};
  t.scene.emitters = {{.mouth = RectMouth{{0, 0, 0}, {0.3, 0.2}, {1, 0, 0}, {0, 1, 0}}, .flow = 0.12, .from = 0.013, .until = 0.2}};
  t.step = 2e-3;
  auto run = start(t);
  for (int frame = 0; frame < 18; ++frame) run->advance(1.0 / 60);
  expectBirths(t, *run, 0.05, 0.05);
}

// Waits, swings, turns while it swings, turns back, and rests. It does not follow what has left it.
std::vector<Keyframe> swing() {
  return {{.at = 0.05, .translate = {0.1, 0, 0}},
          {.at = 0.15, .translate = {0, 0.2, 0}},
          {.at = 0.3, .translate = {-0.1, 0, -0.3}, .rotate = turn({0, 0.6, 0.8}, 1.1)},
          {.at = 0.36, .translate = {-0.1, 0, -0.3}, .rotate = turn({0, 0.6, 0.8}, 0.7)}};
}

// A jet of rest density in the frame of a mouth that moves evenly: nothing but its own time matters for a particle.
TEST_F(FlowsTest, ParticlesLeaveMouthsThatMove) {
  Trial t = space();
  t.scene.emitters = {disc({0.1, 0.2, 0.3}, 0.15, {1, 2, -0.5}, 1.5)};
  t.scene.emitters[0].motion = {{.at = 0.02}, {.at = 0.5, .translate = {0.6, -0.3, 0.4}}};
  expectBirthsInEveryWay(t);
}

TEST_F(FlowsTest, SingleParticlesLeaveMouthsThatTurn) {
  Trial t = space();
  t.scene.emitters = {disc({0, 0, 0}, 0.03, {1, 0, 0}, 4)};
  t.scene.emitters[0].motion = swing();
  for (const double step : {1e-3, 5e-3}) {
    SCOPED_TRACE(step);
    t.step = step;
    auto run = start(t);
    for (int frame = 0; frame < 8; ++frame) run->advance(0.05);
    expectBirths(t, *run, 2e-3, 2e-3);
  }
}

TEST_F(FlowsTest, FlowIsExactWhateverTheFrames) {
  Trial t = space();
  t.scene.emitters = {disc({0, 0, 0}, 0.2, {0, 1, 0}, 2),
                      {.mouth = RectMouth{{3, 0, 0}, {0.4, 0.3}, {0, 1, 0}, {0, 0, 1}}, .flow = 0.03, .until = 0.31}};
  t.step = 4e-3;
  const double area = mouthLattice(t.scene.emitters[0].mouth, t.d()).area;
  expectExactFlow(t, {2 * area, 0.03}, {0.4, 0.1, 1.0 / 60});
}

TEST_F(FlowsTest, FullCapacityBlocksAndCountsTheTime) {
  Trial t = space(100);
  t.scene.emitters = {disc({0, 0, 0}, 0.15, {1, 0, 0}, 1)};
  auto run = start(t);
  for (int frame = 0; frame < 60; ++frame) run->advance(1.0 / 60);
  const FluidStats s = run->stats();
  EXPECT_EQ(s.particles, 100u);
  EXPECT_EQ(s.ledger.emitted, 100u);
  const MouthLattice lattice = mouthLattice(t.scene.emitters[0].mouth, t.d());
  const double full = 100 * std::pow(t.d(), 3) / lattice.area;  // s
  EXPECT_NEAR(s.emitterBlocked_s, 1 - full, 2 * lattice.thickness);
}

TEST_F(FlowsTest, SolidsAndWallsBlockParticleByParticle) {
  Trial t = space();
  t.scene.solids = {slab({-1, -1, -1}, {1, 1, 0})};
  t.scene.domain = Domain{{-3, -3, -3}, {3, 3, 3}};
  t.origin = {-3, -3, -3};
  t.scene.emitters = {disc({0, 0, 0}, 0.3, {1, 0, 0}, 1), disc({0, 0, -0.5}, 0.1, {1, 0, 0}, 1), disc({0, 3.5, 0}, 0.1, {1, 0, 0}, 1)};
  auto run = start(t);
  run->advance(0.3);
  expectBalance(*run);
  const auto emitted = run->fluid().emitted();
  const MouthLattice lattice = mouthLattice(t.scene.emitters[0].mouth, t.d());
  EXPECT_GT(emitted[0].particles, 0u);
  EXPECT_LT(emitted[0].volume, 0.7 * lattice.area * 0.3);
  EXPECT_EQ(emitted[1].particles, 0u) << "in the solid";
  EXPECT_EQ(emitted[2].particles, 0u) << "behind the wall";
  const FluidStats stats = run->stats();
  EXPECT_GT(stats.emitterBlocked_s, 0.1);
  ASSERT_EQ(stats.emittersBlocked_s.size(), 3U);
  EXPECT_GT(stats.emittersBlocked_s[1], 0.1);
  EXPECT_NEAR(stats.emitterBlocked_s, *std::ranges::max_element(stats.emittersBlocked_s), 1e-4) << "all are blocked in the same intervals";
}

TEST_F(FlowsTest, JetsKeepTheirSpeedInAClosedBoxWithoutGravity) {
  Trial t = space();
  t.scene.domain = Domain{{-1, -1, -1}, {3, 1, 1}};
  t.origin = {-1, -1, -1};
  t.scene.emitters = {disc({0, 0, 0}, 0.15, {1, 0, 0}, 6)};
  t.scene.solver.cfl = 0.25;
  auto run = start(t);
  for (int frame = 0; frame < 20; ++frame) run->advance(0.02);
  const FluidSnapshot state = run->saved();
  for (const auto& [id, particle] : particles(state))
    if (particle.first.x < 3) { EXPECT_NEAR(particle.second.x, 6, 0.1) << id; }
}

TEST_F(FlowsTest, PushesSubmergedFluidAwayWithoutABang) {
  Trial t = tank();
  t.settle = true;
  t.scene.solver.tolerance = 1e-3;
  t.scene.emitters = {disc({0.5, 0.25, 0.25}, 0.15, {1, 0, 0}, 0.5)};
  t.step = 5e-3;
  auto run = start(t);
  double mean = 0, worst = 0, fastest = 0;
  for (int frame = 0; frame < 60; ++frame) {
    run->advance(1.0 / 60);
    const FluidStats s = run->stats();
    mean += s.densityErrorMean / 60;
    worst = std::max(worst, s.densityErrorMean);
    fastest = std::max(fastest, s.maxSpeed);
  }
  EXPECT_LT(mean, 1e-3) << "the tolerance";
  EXPECT_LT(worst, 5e-3) << "single frames peak at 3 times the tolerance";
  EXPECT_LT(fastest, 1.5) << "three times the speed of the tap";
}

}  // namespace flows_test
}  // namespace rill::test
