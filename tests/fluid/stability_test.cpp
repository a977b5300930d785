// Bounds on steps and gains follow the fluid as it is: the device's formulas against stability_limits.cpp, and tanks that are filled later.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/rig.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace stability_test {

constexpr double kFrame = 1.0 / 60;

/// Water that fills its tank from side to side, in the longest stable steps.
Trial tank(int layers) {
  Trial t = trial();
  t.scene.solver.relaxation.reset();
  t.scene.solver.warm_start.reset();
  setWalls(t, {8 * t.d(), 40 * t.d(), 8 * t.d()}, 8);  // open above
  t.x = block({8, layers, 8}, t.d());
  t.step = kFrame;
  return t;
}

/// Gravity times height.
double headOf(const Trial& t, double layers) { return -t.scene.gravity[1] * layers * t.d(); }

class StabilityTest : public FluidTest {
 protected:
  /// The fluid after `frames`, with more particles at rest. What it is made from has the extent of the shallow tank.
  std::unique_ptr<Run> filled(Trial t, const std::vector<Float3>& more, int frames = 1) {
    auto run = start(t);
    run->advance(frames * kFrame);
    FluidSnapshot state = run->saved();
    append(state, more, std::vector<Float3>(more.size()));
    t.x.resize(t.x.size() + more.size(), t.x.front());
    return start(t, &state);
  }

  struct Figures {
    double maxEnergy = 0;  ///< over the first, potential energy from the floor
    double meanError = 0;
  };
  Figures follow(Run& run, int frames) {
    const auto energy = [](const FluidStats& s) { return s.kinetic_J + s.potential_J; };
    const double first = energy(run.stats());
    Figures figures;
    for (int frame = 0; frame < frames; ++frame) {
      run.advance(kFrame);
      const FluidStats s = run.stats();
      figures.maxEnergy = std::max(figures.maxEnergy, energy(s) / first);
      figures.meanError += s.densityErrorMean / frames;
    }
    return figures;
  }
  /// `energy`: difference that is allowed.
  static void expectAsStable(const Figures& later, const Figures& full, double energy) {
    EXPECT_LT(later.maxEnergy, 1.01);
    EXPECT_NEAR(later.maxEnergy, full.maxEnergy, energy);
    EXPECT_LT(later.meanError, 1.1 * full.meanError);
  }
};

// With the bounds of the start's four layers the energy is five times as much after 20 frames where there is no tolerance; with one the
// error is twice as much where the step is not made short when the water is added.
TEST_F(StabilityTest, TankFilledLaterIsAsStableAsOneReleasedFull) {
  std::vector<Float3> more;
  for (const glm::dvec3& x : block({8, 16, 8}, tank(4).d(), {0, 4 * tank(4).d(), 0}))
    more.push_back({static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)});
  for (const double tolerance : {0.0, 0.001}) {
    SCOPED_TRACE(tolerance);
    const auto timed = [&](int layers) {
      Trial t = tank(layers);
      t.scene.solver.tolerance = tolerance;
      return t;
    };
    const Figures full = follow(*start(timed(20)), 24);
    auto run = filled(timed(4), more);
    const Figures later = follow(*run, 24);
    EXPECT_NEAR(run->control().head, headOf(tank(20), 19), 0.01 * headOf(tank(20), 19));
    expectAsStable(later, full, 0.005);
  }
}

// A basin of solids without a domain, which starts with one layer.
TEST_F(StabilityTest, BasinFilledLaterHasTheBoundsOfOneReleasedFull) {
  const auto basin = [](int layers) {
    Trial t = tank(layers);
    t.scene.domain.reset();
    const double side = 8 * t.d(), high = 40 * t.d(), thick = 4 * t.d();
    t.scene.solids = {slab({-thick, -thick, -thick}, {side + thick, 0, side + thick}), slab({-thick, 0, -thick}, {0, high, side + thick}),
                      slab({side, 0, -thick}, {side + thick, high, side + thick}), slab({0, 0, -thick}, {side, high, 0}),
                      slab({0, 0, side}, {side, high, side + thick})};
    return t;
  };
  std::vector<Float3> more;
  for (const glm::dvec3& x : block({8, 11, 8}, tank(1).d(), {0, tank(1).d(), 0}))
    more.push_back({static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)});
  const Figures full = follow(*start(basin(12)), 24);
  Trial shallow = basin(1);
  shallow.capacity = 12 * 64;
  auto run = start(shallow);
  run->advance(kFrame);
  FluidSnapshot state = run->saved();
  append(state, more, std::vector<Float3>(more.size()));
  auto filled = start(shallow, &state);
  const Figures later = follow(*filled, 24);
  EXPECT_NEAR(filled->control().head, headOf(tank(12), 11), 0.02 * headOf(tank(12), 11));
  expectAsStable(later, full, 0.01);
}

// Spray, what has left the domain or the simulation, and what is no number.
TEST_F(StabilityTest, IgnoresSparseParticlesInColumnHeight) {
  const Trial t = tank(12);
  const auto at = [&](double layers) { return Float3{0.25f, static_cast<float>(layers * t.d()), 0.25f}; };
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Float3> more = {at(39), at(4000), {kNaN, 0.5f, 0.5f}, {kInactivePosition, kInactivePosition, kInactivePosition}};
  auto run = filled(t, more);
  run->advance(kFrame);
  run->snapshot();
  const double head = run->control().head;
  EXPECT_GE(head, headOf(t, 11) * 0.999) << "as at the start";
  EXPECT_LT(head, headOf(t, 11) * 1.02) << "a drop in 769, three times as high as the fluid";
}

TEST_F(StabilityTest, SplashDoesNotRaiseTheBound) {
  Trial t = trial();
  t.scene.solver.cfl = 0.25;
  setWalls(t, {1, 2, 0.375});
  t.x = block({6, 14, 6}, t.d());
  t.step = kFrame;
  auto run = start(t);
  const double before = implOf(run->fluid()).setup.head;
  double highest = 0;
  for (int frame = 0; frame < 60; ++frame) {
    run->advance(kFrame);
    for (const glm::dvec3& x : run->snapshot().x) highest = std::max(highest, x.y);
  }
  EXPECT_GT(highest, 1.2 * 14 * t.d()) << "it splashes";
  EXPECT_LT(run->control().head, 1.01 * before);
}

// The device's formulas are those of the host.
TEST_F(StabilityTest, DeviceFormulasMatchTheHost) {
  for (const int layers : {3, 12, 30})
    for (const bool given : {false, true}) {
      SCOPED_TRACE(std::to_string(layers) + " layers" + (given ? ", warm start given" : ""));
      Trial t = tank(layers);
      if (given) t.scene.solver.warm_start = 0.01;
      auto run = start(t);
      run->read({.advance_s = kFrame});
      const FluidControl c = run->control();
      const StabilityLimits& limits = implOf(run->fluid()).setup.limits;
      EXPECT_NEAR(c.head, headOf(t, layers - 1), 0.01 * headOf(t, layers - 1));
      EXPECT_NEAR(c.desiredStep / limits.longestStep(c.head), 1, 1e-5);
      const double rest = 1 - std::pow(std::min(c.flowSpeed / limits.motionSpeed(c.head), 1.0), 4);
      EXPECT_NEAR(c.restFraction, rest, 1e-5);
      EXPECT_NEAR(c.nextWarmGain, std::lerp(limits.warmGainInMotion, limits.warmGainAtRest(c.head), rest), 1e-6);
    }
}

// In fluid at rest the step follows a mean of the error's mean, each over substeps in proportion to the layers.
TEST_F(StabilityTest, StepFollowsErrorSlowlyInDeepWater) {
  for (const int layers : {4, 20}) {
    Trial t = tank(layers);
    t.scene.solver.tolerance = 0.002;
    auto run = start(t);
    run->read({.advance_s = 1e-4});
    const FluidControl before = run->control();
    run->read({.advance_s = 1e-4});
    const FluidControl after = run->control();
    ASSERT_EQ(after.substeps, 1u);
    const double share = implOf(run->fluid()).setup.limits.errorRateShareAtRest(after.head);
    const double now = std::max<double>(after.error, 1e-9) / (after.step * after.step), taken = std::pow(share, after.restFraction);
    EXPECT_NEAR(after.errorRate / std::lerp(before.errorRate, now, taken), 1, 1e-4) << layers;
    const double wanted = std::lerp<double>(before.desiredStep, std::sqrt(t.scene.solver.tolerance / after.errorRate), taken);
    EXPECT_NEAR(after.desiredStep / std::clamp(wanted, 0.995 * before.desiredStep, 1.002 * before.desiredStep), 1, 1e-5) << layers;
    EXPECT_NEAR(share, 0.1 / (layers - 1), 0.01 * share);
  }
}

}  // namespace stability_test
}  // namespace rill::test
