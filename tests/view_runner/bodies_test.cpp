// Bodies in the viewer, without a window: pulled, thrown, and made heavier while they float.
#include <gtest/gtest.h>

#include <cmath>

#include "view_runner/session_rig.hpp"

namespace rill::view {
namespace {

constexpr const char* kHarbor = R"({
  "rill": "0.2", "domain": {"min": [1, 0, 0], "max": [2, 1.4, 0.6]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [1, 0, 0], "max": [2, 0.4, 0.6]}}],
  "solids": [{"name": "buoy", "box": {"min": [1.15, 0.3, 0.2], "max": [1.35, 0.5, 0.4]}, "friction": 0.3, "body": {"density": 500}}]
})";
constexpr const char* kDry = R"({
  "rill": "0.2", "domain": {"min": [0, 0, 0], "max": [2, 2, 2]}, "fluid": {"spacing": 0.05},
  "solids": [{"sphere": {"center": [0.4, 1, 0.5], "radius": 0.1}, "body": {"mass": 2}}]
})";
constexpr const char* kDamAlone = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.6]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.4, 0.6]}}]
})";

class ViewedBodiesTest : public SessionTest {
 protected:
  double height(uint32_t solid) { return runner().pose(solid).center.y; }
};

TEST_F(ViewedBodiesTest, RightDragPullsThem) {
  open(kHarbor);
  const double before = height(0);
  const auto held = touch_.grab(session(), eye(), at(1.25, before + 0.02), Hold::Solid);
  ASSERT_TRUE(held && *held);
  EXPECT_EQ(session().scene().solids[0].driven, 0) << "it is no driven solid";
  touch_.drag(session(), eye(), at(1.35, 0.9));
  const auto line = touch_.pullLine(session());
  ASSERT_TRUE(line);
  EXPECT_NEAR((*line)[1].y, 0.9, 1e-9);
  EXPECT_LT((*line)[0].y, 0.6);
  steps(3);
  EXPECT_LT(height(0), 0.85) << "it is pulled, not put there";
  steps(57);
  EXPECT_NEAR(height(0), 0.9, 0.15);
  EXPECT_GT(height(0), before + 0.2);
  ASSERT_TRUE(touch_.release(session()));
  EXPECT_FALSE(touch_.pullLine(session()));
  steps(30);
  EXPECT_LT(height(0), 0.65) << "it falls back";
  EXPECT_EQ(stats().nonFinite + stats().outside, 0u);
}

TEST_F(ViewedBodiesTest, ThrownCratesJoinOthers) {
  open(kHarbor);
  steps(5);
  const uint32_t particles = runner().fluid().count();
  const BodyMotion before = runner().fluid().bodies()[0];
  const uint64_t ran = runner().steps();
  auto thrown = Touch::throwCrate(session(), at(1.65, 0.9));
  ASSERT_TRUE(thrown) << thrown.error().message;
  ASSERT_EQ(runner().fluid().bodies().size(), 2u);
  EXPECT_EQ(runner().steps(), ran) << "time goes on";
  const BodyMotion after = runner().fluid().bodies()[0], crate = runner().fluid().bodies()[1];
  EXPECT_EQ(after.center, before.center);
  EXPECT_EQ(after.velocity, before.velocity);
  EXPECT_EQ(after.rotation, before.rotation);
  EXPECT_NEAR(crate.velocity.z, -Touch::maxSpeed(session()), 1e-6);
  const auto* box = std::get_if<BoxShape>(&session().scene().solids[1].shape);
  ASSERT_NE(box, nullptr);
  EXPECT_GE(box->max.x - box->min.x, 5 * 0.05 - 1e-9);
  EXPECT_LE(box->max.x - box->min.x, 8 * 0.05 + 1e-9);
  steps(60);
  EXPECT_EQ(runner().fluid().count(), particles);
  const FluidStats now = stats();
  EXPECT_EQ(now.particles, particles);
  EXPECT_EQ(now.nonFinite + now.outside, 0u);
  EXPECT_LT(height(1), 0.8) << "it has fallen";
  EXPECT_GT(height(1), 0.1) << "it floats";
  ASSERT_TRUE(session().change({"fluid.viscosity", "0.1"}));
  EXPECT_EQ(runner().fluid().bodies().size(), 2u) << "a live change leaves it";
  ASSERT_TRUE(session().restart());
  EXPECT_EQ(runner().fluid().bodies().size(), 1u);
}

TEST_F(ViewedBodiesTest, FluidAndSolidsAreChangedBesideThem) {
  open(kHarbor);
  ASSERT_TRUE(Touch::throwCrate(session(), at(1.65, 0.9)));
  steps(10);
  const Pose buoy = runner().pose(0), crate = runner().pose(1);
  const auto held = touch_.grab(session(), eye(), at(1.5, 0.2), Hold::Fluid);
  ASSERT_TRUE(held && *held) << "a ball pushes the fluid";
  EXPECT_EQ(runner().pose(0).center, buoy.center);
  EXPECT_EQ(runner().pose(1).center, crate.center);
  EXPECT_EQ(runner().pose(1).velocity, crate.velocity);
  ASSERT_TRUE(touch_.release(session()));
  EXPECT_EQ(runner().pose(1).center, crate.center);
  const uint32_t particles = runner().fluid().count();
  const auto added = Touch::throwFluid(session(), at(1.3, 1.1));
  ASSERT_TRUE(added) << added.error().message;
  EXPECT_EQ(runner().fluid().count(), particles + *added);
  EXPECT_EQ(runner().pose(0).center, buoy.center);
  EXPECT_EQ(runner().pose(1).center, crate.center);
}

TEST_F(ViewedBodiesTest, CratesAreRefusedWhereThereIsNoRoom) {
  open(kHarbor);
  std::string message;
  for (int k = 0; k < 20 && message.empty(); ++k)
    if (auto thrown = Touch::throwCrate(session(), at(1.65, 0.9)); !thrown) message = thrown.error().message;
  EXPECT_EQ(message.find("A crate cannot be thrown there: it would overlap solids["), 0u) << message;
  const auto missed = Touch::throwCrate(session(), {{1.5, 0.5, 3}, {0, 0, 1}});
  ASSERT_FALSE(missed);
  EXPECT_NE(missed.error().message.find("miss the scene"), std::string::npos) << missed.error().message;
  const auto wet = Touch::throwCrate(session(), at(1.6, 0.1));
  ASSERT_FALSE(wet);
  EXPECT_NE(wet.error().message.find("overlap fluid"), std::string::npos) << wet.error().message;
}

TEST_F(ViewedBodiesTest, CratesFallIntoScenesWithoutBodies) {
  open(kDamAlone);
  const double time = runner().time_s();
  ASSERT_TRUE(Touch::throwCrate(session(), {{0.7, 0.7, 3}, {0, 0, -1}}));
  ASSERT_EQ(runner().fluid().bodies().size(), 1u);
  EXPECT_EQ(runner().fluid().count(), 10u * 8 * 12);
  steps(10);
  EXPECT_NEAR(runner().time_s(), time + 10.0 / 60, 1e-5);
  EXPECT_LT(height(0), 0.7);
  EXPECT_EQ(stats().nonFinite + stats().outside, 0u);
}

TEST_F(ViewedBodiesTest, ScenesWithoutFluidKeepTheirMotion) {
  open(kDry);
  steps(10);
  const double y = height(0), time = runner().time_s();
  EXPECT_LT(y, 0.99) << "it falls";
  ASSERT_TRUE(Touch::throwCrate(session(), {{1.2, 1.5, 5}, {0, 0, -1}}));
  EXPECT_EQ(height(0), y);
  ASSERT_TRUE(session().change({"fluid.viscosity", "0.1"}));
  EXPECT_EQ(height(0), y);
  EXPECT_EQ(runner().time_s(), time);
}

TEST_F(ViewedBodiesTest, DensityChangesTheDraughtLive) {
  open(kHarbor);
  const std::string key = "solids[0].body.density";
  ASSERT_TRUE(session().isLive(key));
  EXPECT_FALSE(session().isLive("solids[0].friction"));
  EXPECT_FALSE(session().isLive("solids[7].body.density"));
  steps(40);
  const double half = height(0);
  const uint64_t ran = runner().steps();
  ASSERT_TRUE(session().changeDensity(0, 900));
  EXPECT_EQ(session().scene().solids[0].body->density, 900);
  EXPECT_TRUE(session().isChanged(key));
  EXPECT_EQ(runner().steps(), ran);
  EXPECT_NEAR(height(0), half, 1e-6) << "it goes on from where it is";
  steps(40);
  EXPECT_LT(height(0), half - 0.03) << "0.08 m at rest";
  ASSERT_TRUE(session().changeDensity(0, 200));
  steps(40);
  EXPECT_GT(height(0), half + 0.02);
  ASSERT_TRUE(Touch::throwCrate(session(), at(1.65, 0.9)));
  ASSERT_TRUE(session().changeDensity(1, 3000)) << "of one that is in no file";
  EXPECT_EQ(session().scene().solids[1].body->density, 3000);
  EXPECT_EQ(session().changes().size(), 1u);
}

}  // namespace
}  // namespace rill::view
