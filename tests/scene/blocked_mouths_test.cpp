// Warnings about mouths of emitters that are blocked at the start, and the origin of scenes without fills.
#include <cmath>

#include "support.hpp"

namespace rill::test {
namespace {

/// A closed tank of 2 x 1 x 1 m at a spacing of 0.1 m, with a solid box from (0.5, 0, 0) to (1, 0.5, 1).
Scene tankWith(std::vector<Mouth> mouths) {
  Scene s;
  s.name = "dam";
  s.fluid.spacing = 0.1;
  s.domain = Domain{{0, 0, 0}, {2, 1, 1}};
  s.solids = {{.shape = BoxShape{{0.5, 0, 0}, {1, 0.5, 1}}}};
  for (const Mouth& mouth : mouths) s.emitters.push_back({.mouth = mouth, .flow = 0.01});
  return s;
}

using Texts = std::vector<std::string>;

Texts warningsOf(Scene s) { return particles(s).warnings; }
Texts warningsOf(const Mouth& mouth) { return warningsOf(tankWith({mouth})); }

const Texts kInside{"dam: emitters[0]: its mouth is inside solids[0]; it is blocked"},
    kOutside{"dam: emitters[0]: its mouth is outside the domain's walls; it is blocked"};

TEST(BlockedMouths, FreeOnesAreNotWarnedAbout) {
  EXPECT_EQ(warningsOf(DiscMouth{.center = {1.5, 0.5, 0.5}, .radius = 0.1}), Texts{});
  EXPECT_EQ(warningsOf(DiscMouth{.center = {1.5, 1, 0.5}, .radius = 0.1}), Texts{}) << "in the ceiling";
  EXPECT_EQ(warningsOf(DiscMouth{.center = {0.75, 0.5, 0.5}, .radius = 0.1}), Texts{}) << "on the solid";
}

TEST(BlockedMouths, InsideSolids) {
  EXPECT_EQ(warningsOf(DiscMouth{.center = {0.75, 0.25, 0.5}, .radius = 0.2}), kInside);
  EXPECT_EQ(warningsOf(RectMouth{.center = {0.75, 0.25, 0.5}, .size = {0.2, 0.2}}), kInside);
  EXPECT_EQ(warningsOf(DiscMouth{.center = {0.75, 0.25, 0.5}, .radius = 0.4}), Texts{}) << "a part is free";
  EXPECT_EQ(warningsOf(RectMouth{.center = {0.75, 0.25, 0.5}, .size = {0.2, 0.8}, .up = {1, 0, 0}}), Texts{}) << "0.8 m along x";
  EXPECT_EQ(warningsOf(RectMouth{.center = {0.75, 0.25, 0.5}, .size = {0.2, 0.8}, .up = {0, 0, 1}}), kInside) << "0.8 m along z";
  EXPECT_EQ(warningsOf(DiscMouth{.center = {0.75, 0.25, 0.5}, .radius = 0.01}), kInside) << "narrower than the spacing";
}

TEST(BlockedMouths, OutsideClosedWalls) {
  const DiscMouth above{.center = {1.5, 1.5, 0.5}, .radius = 0.1};
  EXPECT_EQ(warningsOf(above), kOutside);
  Scene s = tankWith({above});
  s.domain->open = 0b1000;  // +y
  EXPECT_EQ(warningsOf(s), Texts{});
  s.domain.reset();
  EXPECT_EQ(warningsOf(s), Texts{});
}

TEST(BlockedMouths, StartWhereTheirMotionDoes) {
  Scene s = tankWith({DiscMouth{.center = {0.75, 0.25, 0.5}, .radius = 0.2}});
  s.emitters[0].motion = {{.at = 0}, {.at = 1, .translate = {1, 0, 0}}};
  EXPECT_EQ(warningsOf(s), Texts{"dam: emitters[0]: its mouth is inside solids[0]; it is blocked until it moves away"});
  s.emitters[0].motion = {{.at = 0, .translate = {0.75, 0, 0}}, {.at = 1}};
  EXPECT_EQ(warningsOf(s), Texts{});
}

TEST(BlockedMouths, NameAllThatCoversThem) {
  const RectMouth wide{.center = {1.02, 0.25, 0.5}, .size = {0.5, 0.9}, .up = {1, 0, 0}};  // x from 0.57 to 1.47
  EXPECT_EQ(warningsOf(wide), Texts{});
  Scene s = tankWith({wide});
  s.solids.push_back({.shape = BoxShape{{1, 0, 0}, {1.5, 0.5, 1}}});
  EXPECT_EQ(warningsOf(s), Texts{"dam: emitters[0]: its mouth is inside solids[0], solids[1]; it is blocked"});
  s.solids.pop_back();
  s.domain->max[0] = 0.95;
  EXPECT_EQ(warningsOf(s), Texts{"dam: emitters[0]: its mouth is inside solids[0] and outside the domain's walls; it is blocked"});
}

TEST(BlockedMouths, SolidsMayMoveAway) {
  Scene s = tankWith({DiscMouth{.center = {0.75, 0.25, 0.5}, .radius = 0.1}});
  const Texts until{"dam: emitters[0]: its mouth is inside solids[0]; it is blocked until a solid moves away"};
  s.solids[0].motion = {{.at = 0}, {.at = 1, .translate = {0, 1, 0}}};
  EXPECT_EQ(warningsOf(s), until);
  s.solids[0].motion = {{.at = 0, .translate = {0.5, 0, 0}}, {.at = 1}};
  EXPECT_EQ(warningsOf(s), Texts{}) << "elsewhere at the start";
  s.solids[0].motion.clear();
  s.solids[0].body = Body{.density = 500};
  EXPECT_EQ(warningsOf(s), until);
}

TEST(BlockedMouths, ManyAreSummedUp) {
  std::vector<Mouth> mouths;
  for (int k = 0; k < 30; ++k) mouths.push_back(DiscMouth{.center = {5.0 + k, 5, 5}, .radius = 0.1});
  const Scene s = tankWith(mouths);
  const Texts warnings = warningsOf(s);
  ASSERT_EQ(warnings.size(), 21U);
  EXPECT_EQ(warnings[19], "dam: emitters[19]: its mouth is outside the domain's walls; it is blocked");
  EXPECT_EQ(warnings[20], "and 10 more warnings about emitters and drains");
}

TEST(BlockedMouths, UseTheSpacingThatParticlesGive) {
  Scene s = tankWith({DiscMouth{.center = {0.75, 0.25, 0.5}, .radius = 0.2}});
  s.fluid.spacing = 0;
  s.fluid.particles = 500;
  s.fill = {{.shape = BoxShape{{1.2, 0, 0}, {2, 0.5, 1}}}};
  EXPECT_EQ(warningsOf(s), kInside);
}

TEST(BlockedMouths, OriginWithoutFillsIsNearTheMouths) {
  Scene s = tankWith({DiscMouth{.center = {5000, 100, 7}, .radius = 0.1}, DiscMouth{.center = {5001, 100, 7}, .radius = 0.1}});
  s.domain.reset();
  const ParticleSet set = particles(s);
  EXPECT_NEAR(set.origin.x, 5000.5, 0.051);
  EXPECT_NEAR(set.origin.y, 100, 0.051);
  EXPECT_NEAR(set.origin.z, 7, 0.051);
  EXPECT_EQ(set.warnings, Texts{});
}

}  // namespace
}  // namespace rill::test
