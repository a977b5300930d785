// Warnings about emitters, drains, inflow and outflow that cannot do what they are given for.
#include "support.hpp"

namespace rill::test {
namespace {

using Lines = std::vector<std::string>;

/// A closed tank of 1 m^3 at a spacing of 0.1 m, with a tap of 0.01 m^3/s over 10 s.
Scene tankWithTap() {
  Scene s;
  s.name = "tank";
  s.fluid.spacing = 0.1;
  s.domain = Domain{{0, 0, 0}, {1, 1, 1}};
  s.duration = 10;
  s.emitters = {{.mouth = DiscMouth{.center = {0.5, 0.8, 0.5}, .radius = 0.1}, .flow = 0.01}};
  return s;
}

Lines flowWarningsOf(Scene s) { return particles(s).warnings; }

TEST(FlowWarnings, AcceptsDrainsThatFluidReaches) {
  Scene s = tankWithTap();
  EXPECT_EQ(flowWarningsOf(s), Lines{});
  s.drains = {{.shape = BoxShape{{0, 0, 0}, {1, 0.1, 1}}}, {.shape = SphereShape{{0.5, 0, 0.5}, 0.2}}};
  s.domain->outflow = Outflow{Axis::PlusX, 0.2};
  EXPECT_EQ(flowWarningsOf(s), Lines{});
}

TEST(FlowWarnings, NamesDrainsOutsideTheWalls) {
  Scene s = tankWithTap();
  s.drains = {{.shape = BoxShape{{1.1, 0, 0}, {1.4, 1, 1}}}, {.shape = SphereShape{{0.5, -0.3, 0.5}, 0.2}}};
  EXPECT_EQ(flowWarningsOf(s), (Lines{"tank: drains[0]: it is outside the domain's walls; nothing gets there",
                                      "tank: drains[1]: it is outside the domain's walls; nothing gets there"}));
  s.drains[0].shape = BoxShape{{0, -1, 0}, {1, 0, 1}};
  EXPECT_EQ(flowWarningsOf(s).size(), 2U) << "it ends at the wall";
  s.domain->open = 0b110;  // +x and -y
  EXPECT_EQ(flowWarningsOf(s), Lines{});
}

TEST(FlowWarnings, NamesDrainsThinnerThanASubstepMoves) {
  Scene s = tankWithTap();
  s.drains = {{.shape = BoxShape{{0, 0.1, 0}, {1, 0.101, 1}}}, {.shape = SphereShape{{0.5, 0.3, 0.5}, 0.001}}};
  EXPECT_EQ(flowWarningsOf(s),
            (Lines{"tank: drains[0]: it is 0.001 m thick within the walls; expected at least 0.05 m, as far as a substep "
                   "may move a particle (solver.cfl): some pass it",
                   "tank: drains[1]: it is 0.002 m thick within the walls; expected at least 0.05 m, as far as a substep "
                   "may move a particle (solver.cfl): some pass it"}));
}

TEST(FlowWarnings, NamesMouthsThatOverlap) {
  Scene s = tankWithTap();
  s.duration = 1;
  s.emitters.push_back({.mouth = RectMouth{.center = {0.65, 0.8, 0.5}, .size = {0.2, 0.2}}, .flow = 0.01});
  s.emitters.push_back({.mouth = RectMouth{.center = {0.85, 0.8, 0.5}, .size = {0.2, 0.2}}, .flow = 0.01});
  const Lines found{
      "tank: emitters[1]: its mouth overlaps that of emitters[0]; expected mouths apart, or open at other times: what they emit starts "
      "compressed and accelerates apart"};
  EXPECT_EQ(flowWarningsOf(s), found) << "the last two are side by side";
  s.emitters[0].until = s.emitters[1].from = 0.5;
  EXPECT_EQ(flowWarningsOf(s), Lines{});
  s.emitters[0].until.reset();
  s.emitters[1].motion = {{0, {0, 0, 0}}, {1, {0, -0.5, 0}}};
  EXPECT_EQ(flowWarningsOf(s), Lines{});
  s.emitters[1].motion.clear();
  s.domain->inflow = Inflow{.side = Axis::MinusX, .level = 0.9, .speed = 0.1};
  s.emitters.resize(1);
  s.emitters[0].mouth = DiscMouth{.center = {0.05, 0.5, 0.5}, .radius = 0.1, .normal = {1, 0, 0}};
  s.domain->outflow = Outflow{Axis::PlusX, 0.2};
  EXPECT_EQ(flowWarningsOf(s).size(), 1U) << "a fine mouth in a coarse one";
}

TEST(FlowWarnings, ComparesMouthsOfAnyShape) {
  Scene s = tankWithTap();
  s.duration = 1e-3;
  s.fluid.spacing = 0.02;
  const auto overlaps = [&](const Mouth& a, const Mouth& b) {
    s.emitters = {{.mouth = a, .flow = 0.001}, {.mouth = b, .flow = 0.001}};
    return flowWarningsOf(s).size() == 1;
  };
  s.domain = Domain{{-3, -3, -3}, {3, 3, 3}};
  const RectMouth wall{.center = {0, 0, 0}, .size = {2.4, 2.4}, .normal = {0, 0, 1}, .up = {0, 1, 0}};
  EXPECT_FALSE(overlaps(wall, RectMouth{.center = {0, 0, -0.1}, .size = {2.4, 2.4}, .normal = {0, 0, -1}, .up = {0, 1, 0}}))
      << "back to back";
  EXPECT_TRUE(overlaps(wall, RectMouth{.center = {1, 1, 0.01}, .size = {2.4, 2.4}, .normal = {0, 0, 1}, .up = {0, 1, 0}}));
  EXPECT_FALSE(overlaps(wall, RectMouth{.center = {2.4, 0, 0}, .size = {2.4, 2.4}, .normal = {0, 0, 1}, .up = {0, 1, 0}}))
      << "side by side";
  const RectMouth slit{.center = {0, 0, 0}, .size = {3.9, 0.3}, .normal = {0, 0, 1}, .up = {0, 1, 0}};
  for (const double x : {0.0, 0.1, 0.13, 1.9})
    EXPECT_TRUE(overlaps(slit, DiscMouth{.center = {x, 0, 0}, .radius = 0.03, .normal = {0, 0, 1}})) << x;
  EXPECT_FALSE(overlaps(slit, DiscMouth{.center = {2, 0, 0}, .radius = 0.03, .normal = {0, 0, 1}}));
}

TEST(FlowWarnings, NamesMouthsThatOpenTooLateOrAreDrained) {
  Scene s = tankWithTap();
  s.emitters[0].from = 12;
  s.drains = {{.shape = BoxShape{{0, 0.5, 0}, {1, 1, 1}}}};
  EXPECT_EQ(flowWarningsOf(s), (Lines{"tank: emitters[0].from: found 12 s, expected a time before the scene's duration of 10 s, or "
                                      "fluid.capacity: room is kept for a layer of it alone",
                                      "tank: emitters[0]: its mouth is inside drains[0], which removes its fluid at once"}));
  s.emitters[0].from = 0;
  EXPECT_EQ(flowWarningsOf(s).size(), 1U);
  s.drains[0].from = 5;
  EXPECT_EQ(flowWarningsOf(s), Lines{}) << "the drain opens later";
  s.drains[0].from = 0;
  s.drains[0].until = 5;
  EXPECT_EQ(flowWarningsOf(s), Lines{}) << "it closes earlier";
  s.drains[0].until.reset();
  s.emitters[0].motion = {{0, {0, 0, 0}}, {1, {0, -0.5, 0}}};
  EXPECT_EQ(flowWarningsOf(s), Lines{}) << "the mouth leaves it";
  s.emitters[0].motion.clear();
  s.drains[0].shape = SphereShape{{0.5, 0.8, 0.5}, 0.05};
  EXPECT_EQ(flowWarningsOf(s), Lines{}) << "it is smaller than the mouth";
}

TEST(FlowWarnings, NamesLevelsBelowALayer) {
  Scene s = tankWithTap();
  s.domain->inflow = Inflow{.side = Axis::MinusX, .level = 0.05, .speed = 0.1};
  s.domain->outflow = Outflow{Axis::PlusX, 0.01};
  EXPECT_EQ(flowWarningsOf(s),
            (Lines{"tank: domain.inflow.level: found 0.05 m, expected at least fluid.spacing, 0.1 m, the height of a layer",
                   "tank: domain.outflow.level: found 0.01 m, expected at least fluid.spacing, 0.1 m, the height of a layer"}));
}

TEST(FlowWarnings, NamesBlockedInflow) {
  Scene s = tankWithTap();
  s.domain->inflow = Inflow{.side = Axis::MinusX, .level = 0.5, .speed = 0.1};
  s.domain->outflow = Outflow{Axis::PlusX, 0.5};
  s.solids = {{.shape = BoxShape{{-1, -1, -1}, {0.2, 2, 2}}}};
  EXPECT_EQ(flowWarningsOf(s), Lines{"tank: domain.inflow: its mouth is inside solids[0]; it is blocked"});
}

TEST(FlowWarnings, NamesClosedDomainThatOverflows) {
  Scene s = tankWithTap();
  s.emitters[0].flow = 0.3;
  s.emitters[0].from = 2;
  const Lines full{
      "tank: emitters: they have filled the closed domain after 5.333 s, and ask for 2.4 times its volume until "
      "duration; expected a drain, an outflow, an open side or a smaller fluid.capacity"};
  EXPECT_EQ(flowWarningsOf(s), full);
  s.fill = {{.shape = BoxShape{{0, 0, 0}, {1, 0.3, 1}}}};
  EXPECT_NE(flowWarningsOf(s).at(0).find("after 4.333 s"), std::string::npos);
  s.fluid.capacity = 1000;
  EXPECT_EQ(flowWarningsOf(s), Lines{}) << "emitters stop in time";
  s.fluid.capacity = 0;
  s.domain->open = 0b1000;
  EXPECT_EQ(flowWarningsOf(s), Lines{});
  s.domain->open = 0;
  s.drains = {{.shape = BoxShape{{1.1, 0, 0}, {1.4, 1, 1}}}};
  EXPECT_EQ(flowWarningsOf(s).size(), 2U) << "nothing reaches the drain";
  s.drains = {{.shape = BoxShape{{0, 0, 0}, {1, 0.2, 1}}, .from = 6}};
  EXPECT_EQ(flowWarningsOf(s).size(), 1U) << "it opens too late";
  s.drains[0].from = 4;
  EXPECT_EQ(flowWarningsOf(s), Lines{});
  s.drains.clear();
  s.emitters[0].until = 4;
  EXPECT_EQ(flowWarningsOf(s), Lines{});
  s.domain.reset();
  s.emitters[0].until.reset();
  EXPECT_EQ(flowWarningsOf(s), Lines{});
}

}  // namespace
}  // namespace rill::test
