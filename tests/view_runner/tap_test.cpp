// The tap of the viewer, without a window.
#include "view/tap.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "view/playback.hpp"
#include "view_runner/session_rig.hpp"

namespace rill::view {
namespace {

constexpr const char* kBasin = R"({
  "rill": "0.2", "domain": {"min": [1, 0, 0], "max": [2, 1.4, 0.6]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [1, 0, 0], "max": [2, 0.2, 0.6]}}]
})";
constexpr const char* kFlowing = R"({
  "rill": "0.2", "domain": {"min": [1, 0, 0], "max": [2, 1.4, 0.6]}, "fluid": {"spacing": 0.05, "capacity": 2000},
  "fill": [{"box": {"min": [1, 0, 0], "max": [2, 0.2, 0.6]}}],
  "emitters": [{"name": "source", "disc": {"center": [1.2, 1, 0.3], "radius": 0.1}, "flow": 0.02}],
  "drains": [{"name": "sink", "box": {"min": [1.8, 0, 0], "max": [2, 0.1, 0.6]}}],
  "probes": [{"name": "in", "flow": "source"}]
})";
constexpr const char* kTwoFluids = R"({
  "rill": "0.2", "domain": {"min": [1, 0, 0], "max": [2, 1.4, 0.6]}, "fluid": {"spacing": 0.05, "viscosity": 0.001},
  "fluids": [{"name": "water"}, {"name": "oil", "density": 900, "viscosity": 0.05}],
  "fill": [{"box": {"min": [1, 0, 0], "max": [2, 0.2, 0.6]}}]
})";
constexpr double kParticle = 0.05 * 0.05 * 0.05;  // m^3

class TapTest : public SessionTest {
 protected:
  FlowReading poured() { return runner().fluid().emitted()[runner().tap().value()]; }
  double layer() { return 2 * 16 * kParticle; }  // more than two layers of the mouth have
  Tap tap_;
};

TEST_F(TapTest, PoursWhileItIsOpen) {
  open(kBasin);
  const uint32_t before = runner().fluid().count();
  EXPECT_FALSE(runner().tap());
  const auto opened = tap_.open(session(), at(1.5, 0.1), 0);
  ASSERT_TRUE(opened) << opened.error().message;
  ASSERT_EQ(runner().tap(), 0u);
  EXPECT_EQ(runner().fluid().count(), before) << "the fluid goes on";
  steps(30);
  const double flow = Tap::defaultFlow(session());
  EXPECT_NEAR(poured().volume, flow * 0.5, layer());
  EXPECT_EQ(runner().fluid().count(), before + poured().particles);
  tap_.close(session());
  steps(1);
  const uint64_t then = poured().particles;
  steps(10);
  EXPECT_EQ(poured().particles, then) << "closed";
  const auto again = tap_.open(session(), at(1.3, 0.1), 2 * flow);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(session().scene().emitters.size(), 1u) << "it is added once";
  steps(15);
  EXPECT_NEAR(static_cast<double>(poured().particles - then) * kParticle, 2 * flow * 0.25, layer());
  EXPECT_EQ(stats().nonFinite + stats().outside, 0u);
}

TEST_F(TapTest, FollowsThePointer) {
  open(kBasin);
  ASSERT_TRUE(tap_.open(session(), at(1.2, 0.1), 0));
  steps(12);
  const uint32_t before = runner().fluid().count();
  tap_.move(session(), eye(), at(1.8, 0.1));
  steps(12);
  const auto positions = runner().positions();
  ASSERT_TRUE(positions);
  ASSERT_GT(positions->size(), before + 10);
  size_t left = 0, right = 0;  // of those that fall
  for (const Float3& p : *positions) {
    if (p.y < 0.3) continue;
    (p.x + runner().start().origin.x < 1.5 ? left : right)++;
  }
  EXPECT_GT(right, 10u);
  EXPECT_GT(right, 2 * left);
}

TEST_F(TapTest, JoinsEmittersAndDrainsOfTheScene) {
  open(kFlowing);
  steps(10);
  const uint64_t source = runner().fluid().emitted()[0].particles, sink = runner().fluid().drained()[0].particles;
  ASSERT_TRUE(tap_.open(session(), at(1.5, 0.1), 0));
  ASSERT_EQ(runner().tap(), 1u);
  EXPECT_EQ(runner().fluid().emitted()[0].particles, source);
  EXPECT_EQ(runner().fluid().drained()[0].particles, sink);
  EXPECT_GT(runner().fluid().capacity(), 2000u) << "room for what it pours";
  ASSERT_TRUE(session().change({"fluid.viscosity", "0.1"}));
  EXPECT_EQ(runner().tap(), 1u) << "a live change leaves it";
  ASSERT_TRUE(Touch::throwCrate(session(), at(1.5, 0.9)));
  EXPECT_EQ(runner().tap(), 1u);
  runner().setEmitter({.emitter = 0});
  steps(2);
  const uint64_t closed = runner().fluid().emitted()[0].particles;
  const uint64_t pouredBefore = poured().particles;
  steps(20);
  EXPECT_EQ(runner().fluid().emitted()[0].particles, closed) << "the host has closed it";
  EXPECT_GT(poured().particles, pouredBefore);
  EXPECT_EQ(runner().flows()[0], 0);
  const FluidLedger ledger = stats().ledger;
  EXPECT_EQ(ledger.filled + ledger.emitted, stats().particles + ledger.drained + ledger.left + ledger.inactive);
  ASSERT_TRUE(session().restart());
  tap_.reset();
  EXPECT_FALSE(runner().tap());
  EXPECT_EQ(runner().flows()[0], 0.02);
}

TEST_F(TapTest, PoursTheChosenFluid) {
  open(kTwoFluids);
  ASSERT_TRUE(tap_.open(session(), at(1.5, 0.1), 0, "oil"));
  EXPECT_EQ(session().scene().emitters.back().fluid, "oil");
  steps(10);
  const uint64_t oil = poured().particles;
  EXPECT_GT(oil, 0u);
  tap_.close(session());
  ASSERT_TRUE(tap_.open(session(), at(1.5, 0.1), 0));
  ASSERT_EQ(session().scene().emitters.size(), 1u) << "the same tap";
  EXPECT_EQ(session().scene().emitters.back().fluid, "");
  EXPECT_EQ(poured().particles, oil);
  steps(10);
  EXPECT_GT(poured().particles, oil);
  EXPECT_EQ(stats().nonFinite + stats().outside, 0u);
}

TEST_F(TapTest, ThrownBallsAreOfTheChosenFluid) {
  open(kTwoFluids);
  const size_t before = runner().start().positions.size();
  const auto thrown = Touch::throwFluid(session(), at(1.5, 0.9), "oil");
  ASSERT_TRUE(thrown) << thrown.error().message;
  const ParticleSet& start = runner().start();
  ASSERT_EQ(start.fluids.size(), start.positions.size());
  for (size_t i = 0; i < start.fluids.size(); ++i) ASSERT_EQ(start.fluids[i], i < before ? 0 : 1);
}

TEST_F(TapTest, ViscosityOfAFluidChangesWhileItRuns) {
  open(kTwoFluids);
  steps(2);
  EXPECT_TRUE(session().isLive("fluids[1].viscosity"));
  EXPECT_FALSE(session().isLive("fluids[1].density"));
  const auto changed = session().change({"fluids[1].viscosity", "0.2"});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(runner().steps(), 3u) << "the fluid goes on";
  EXPECT_EQ(session().scene().fluids[1].viscosity, 0.2);
  ASSERT_TRUE(session().change({"fluids[1].density", "800"}));
  EXPECT_EQ(runner().steps(), 0u) << "it restarts";
  EXPECT_EQ(session().scene().fluids[1].density, 800);
}

TEST_F(TapTest, IsClosedOnANewDevice) {
  open(kFlowing);
  ASSERT_TRUE(tap_.open(session(), at(1.5, 0.1), 0));
  steps(5);
  ASSERT_TRUE(session().keep());
  session().release();
  ASSERT_TRUE(session().resume());
  tap_.reset();
  const uint64_t before = poured().particles, source = runner().fluid().emitted()[0].particles;
  EXPECT_GT(before, 0u);
  steps(15);
  EXPECT_LE(poured().particles, before + 16) << "but for a layer that was under way";
  EXPECT_GT(runner().fluid().emitted()[0].particles, source);
}

TEST_F(TapTest, IsRefusedOutsideTheScene) {
  open(kBasin);
  const auto opened = tap_.open(session(), at(5, 5), 0);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message, "The tap would be outside the scene; point into the tank");
  EXPECT_FALSE(tap_.isOpen());
  EXPECT_FALSE(runner().tap());
}

TEST_F(TapTest, HistoryHasTheFlows) {
  open(kFlowing);
  Playback playback;
  const Playback::Frame frame{.lockstep = true};
  for (int k = 0; k < 61; ++k) ASSERT_TRUE(playback.advance(runner(), frame));
  ASSERT_TRUE(playback.histories().flows);
  EXPECT_EQ(playback.histories().flows->in_L_s.values().size(), 60u);
  const auto& in = playback.histories().flows->in_L_s.values();
  double mean = 0;
  for (size_t k = 30; k < in.size(); ++k) mean += in[k] / 30;
  EXPECT_NEAR(mean, 20, 3) << "L/s";
  EXPECT_GT(playback.histories().flows->out_L_s.values().back(), 0);
}

}  // namespace
}  // namespace rill::view
