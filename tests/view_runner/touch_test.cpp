// Mouse interaction of the viewer, without a window.
#include "view/touch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "offline/painter.hpp"
#include "view_runner/session_rig.hpp"

namespace rill::view {
namespace {

constexpr const char* kPool = R"({
  "rill": "0.1", "domain": {"min": [1, 0, 0], "max": [2, 1, 0.6]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [1, 0, 0], "max": [2, 0.4, 0.6]}}],
  "solids": [{"sphere": {"center": [1.2, 0.7, 0.3], "radius": 0.1}, "motion": [{"at": 0, "translate": [0, 0, 0]}, {"at": 1, "translate": [0.3, 0, 0]}]},
             {"box": {"min": [1.6, 0.55, 0.2], "max": [1.8, 0.75, 0.4]}}]
})";

class TouchTest : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    open(kPool);
  }
};

TEST_F(TouchTest, BallPushesFluidAndIsRemoved) {
  const size_t solids = session().scene().solids.size();
  const uint64_t before = runner().steps();
  const auto held = touch_.grab(session(), eye(), at(1.5, 0.2), Hold::Fluid);
  ASSERT_TRUE(held) << held.error().message;
  ASSERT_TRUE(*held && touch_.holds());
  EXPECT_EQ(session().scene().solids.size(), solids + 1);
  const auto* ball = std::get_if<SphereShape>(&session().scene().solids[solids].shape);
  ASSERT_NE(ball, nullptr);
  const Pose stands = runner().pose(static_cast<uint32_t>(solids));
  EXPECT_GT(stands.center[2] - ball->radius, 0.6 - 0.05) << "before the surface";
  steps(10);
  const Pose in = runner().pose(static_cast<uint32_t>(solids));
  EXPECT_NEAR(in.center[2], 0.6, 0.04) << "half in, where the pointer is";
  EXPECT_NEAR(in.center[0], 1.5, 1e-3);
  const double before_x = stats().momentum[0];
  touch_.drag(session(), eye(), at(1.2, 0.2));
  steps(10);
  EXPECT_NEAR(runner().pose(static_cast<uint32_t>(solids)).center[0], 1.5 - 10.0 / 60, 1e-3) << "1 m/s at most";
  EXPECT_LT(stats().momentum[0], before_x - 0.5) << "kg m/s: the water is pushed along";
  steps(10);
  EXPECT_NEAR(runner().pose(static_cast<uint32_t>(solids)).center[0], 1.2, 1e-3);
  ASSERT_TRUE(touch_.release(session()));
  EXPECT_FALSE(touch_.holds());
  EXPECT_EQ(session().scene().solids.size(), solids);
  EXPECT_EQ(runner().steps(), before + 30) << "time went on";
  steps(2);
  EXPECT_EQ(stats().nonFinite + stats().outside, 0u);
  ASSERT_TRUE(session().restart());
  EXPECT_EQ(session().scene().solids[0].motion.size(), 2u);
}

TEST_F(TouchTest, SolidFollowsPointerAndStays) {
  steps(5);
  const Pose there = runner().pose(0);
  EXPECT_NEAR(there.center[0], 1.2 + 0.3 * 6 / 60, 1e-5) << "its keyframes have moved it";
  auto held = touch_.grab(session(), eye(), at(there.center[0] + 0.05, 0.7), Hold::Solid);
  ASSERT_TRUE(held && *held);
  EXPECT_NEAR(runner().pose(0).center[0], there.center[0], 1e-5) << "it has not jumped";
  touch_.drag(session(), eye(), at(there.center[0] + 0.05, 0.3));
  steps(30);
  EXPECT_NEAR(runner().pose(0).center[1], 0.3, 1e-4);
  EXPECT_NEAR(runner().pose(0).center[0], there.center[0], 1e-4) << "held where it was taken";
  ASSERT_TRUE(touch_.release(session()));
  steps(3);
  EXPECT_NEAR(runner().pose(0).center[1], 0.3, 1e-4);
  ASSERT_TRUE(session().change({"fluid.viscosity", "1"}));
  EXPECT_NEAR(runner().pose(0).center[1], 0.3, 1e-4) << "a live change leaves it there";
  EXPECT_EQ(stats().outside, 0u);
}

TEST_F(TouchTest, DrivenSolidIsDrawnAtItsPose) {
  auto held = touch_.grab(session(), eye(), at(1.7, 0.65), Hold::Solid);
  ASSERT_TRUE(held && *held);
  touch_.drag(session(), eye(), at(1.5, 0.75));
  steps(20);
  const Pose there = runner().pose(1);
  EXPECT_NEAR(there.center[0], 1.5, 1e-4);
  Scene still = session().scene();
  Double3 moved = there.center;
  for (size_t a = 0; a < 3; ++a) moved[a] -= centerOf(still.solids[1])[a];
  translate(still.solids[1], moved);
  still.solids[1].driven = 0;
  const ParticleSet start = runner().start();
  offline::Painter other(still, start);
  for (const char* view : {"final", "particles"}) {
    ASSERT_TRUE(session().painter().prepare(device(), view, 320, 180));
    ASSERT_TRUE(other.prepare(device(), view, 320, 180));
    Graph graph;
    FluidState state = runner().present(graph);
    const Ticket driven = graph.readback(session().painter().addTo(graph, state, view, eye(), 320, 180, runner().time_s()));
    state.solids = {};
    const Ticket placed = graph.readback(other.addTo(graph, state, view, eye(), 320, 180, runner().time_s()));
    run(graph);
    const auto a = read<uint8_t>(graph, driven), b = read<uint8_t>(graph, placed);
    ASSERT_EQ(a.size(), size_t{320} * 180 * 4);
    size_t other_pixels = 0;
    for (size_t i = 0; i < a.size(); i += 4) other_pixels += std::abs(a[i] - b[i]) > 24 ? 1 : 0;
    EXPECT_LE(other_pixels, 40u) << view << ": but for rounding at its edges";
  }
}

TEST_F(TouchTest, IgnoresOtherKindsOfHits) {
  for (const auto& [ray, hold] : {std::pair{at(1.7, 0.65), Hold::Fluid}, {at(1.5, 0.2), Hold::Solid}, {at(1.5, 0.95), Hold::Fluid}}) {
    const auto held = touch_.grab(session(), eye(), ray, hold);
    ASSERT_TRUE(held);
    EXPECT_FALSE(*held);
    EXPECT_FALSE(touch_.holds());
  }
  EXPECT_EQ(session().scene().solids.size(), 2u);
}

TEST_F(TouchTest, ThrownFluidIsAddedWhereThereIsRoom) {
  const uint64_t before = stats().particles;
  const auto thrown = Touch::throwFluid(session(), at(1.5, 0.8));
  ASSERT_TRUE(thrown) << thrown.error().message;
  EXPECT_GT(*thrown, 50u);
  EXPECT_EQ(stats().particles, before + *thrown);
  EXPECT_GT(stats().maxSpeed, 0.9 * Touch::maxSpeed(session()));
  EXPECT_LT(stats().densityErrorMean, 0.01) << "none over another";
  steps(20);
  EXPECT_EQ(stats().nonFinite + stats().outside, 0u);
  const auto hash = runner().hash();
  EXPECT_TRUE(hash) << "ids are still each once";
  const auto missed = Touch::throwFluid(session(), at(5, 5));
  ASSERT_FALSE(missed);
  EXPECT_EQ(missed.error().kind, ErrorKind::BadInput);
}

TEST_F(TouchTest, ThrownFluidHasTheSpacingOfTheScene) {
  const auto by_spacing = Touch::throwFluid(session(), at(1.5, 0.8));
  ASSERT_TRUE(by_spacing) << by_spacing.error().message;
  std::string text = kPool;
  text.replace(text.find(R"("spacing": 0.05)"), 15, R"("particles": 1920)");  // as many as the spacing makes
  auto opened = Session::open(context(), folder.write("counted.json", text));
  ASSERT_TRUE(opened) << opened.error().message;
  ASSERT_TRUE((*opened)->runner().step());
  const auto by_count = Touch::throwFluid(**opened, at(1.5, 0.8));
  ASSERT_TRUE(by_count) << by_count.error().message;
  EXPECT_NEAR(double(*by_count), double(*by_spacing), 0.2 * double(*by_spacing));
}

TEST_F(TouchTest, RandomInteractionStaysStable) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(0.7, 2.3), y(-0.2, 0.8), chance(0, 1);
  uint64_t particles = stats().particles, grabs = 0, throws = 0;
  for (int k = 0; k < 60; ++k) {
    const Ray ray = at(x(random), y(random));
    if (const double what = chance(random); what < 0.25) {
      const auto held = touch_.grab(session(), eye(), ray, what < 0.2 ? Hold::Fluid : Hold::Solid);
      ASSERT_TRUE(held) << held.error().message;
      grabs += *held ? 1 : 0;
    } else if (what < 0.3) {
      ASSERT_TRUE(touch_.release(session()));
    } else if (what < 0.35) {
      if (const auto thrown = Touch::throwFluid(session(), ray)) {
        particles += *thrown;
        ++throws;
      }
    } else {
      touch_.drag(session(), eye(), ray);
    }
    steps(1);
    const FluidStats now = stats();
    ASSERT_EQ(now.particles, particles);
    ASSERT_EQ(now.nonFinite, 0u) << k;
    ASSERT_EQ(now.outside, 0u) << k;
    ASSERT_LT(now.maxSpeed, 60) << k;
  }
  EXPECT_GT(grabs, 3u);
  EXPECT_GT(throws, 0u);
  ASSERT_TRUE(touch_.release(session()));
  steps(90);
  EXPECT_LT(stats().maxSpeed, 1.5) << "it comes to rest";
  EXPECT_LT(stats().densityErrorMean, 0.01);
}

}  // namespace
}  // namespace rill::view
