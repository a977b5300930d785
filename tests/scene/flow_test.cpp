// Emitters, drains, open sides that remove, capacity and probes of flow in scene files.
#include "fill/mouth.hpp"
#include "support.hpp"

namespace rill::test {
namespace {

std::string scene02(const std::string& more) { return R"({"rill": "0.2", "fluid": {"spacing": 0.1}, )" + more + "}"; }
std::string emitter(const std::string& keys) { return scene02(R"("emitters": [{)" + keys + "}]"); }
std::string drain(const std::string& keys) { return scene02(R"("drains": [{)" + keys + "}]"); }

std::string list(const std::string& key, const std::string& entry, int count) {
  std::string entries;
  for (int i = 0; i < count; ++i) entries += (i > 0 ? "," : "") + entry;
  return scene02("\"" + key + "\": [" + entries + "]");
}

TEST(FlowScene, ReadsEveryKey) {
  const Scene s = scene(R"({"rill": "0.2", "fluid": {"spacing": 0.1, "capacity": 5000}, "domain": {"open": ["-y"], "open_removes": true},
    "emitters": [{"name": "tap", "disc": {"center": [1, 2, 3], "radius": 0.5, "normal": [0, -2, 0]}, "flow": 0.25, "from": 1, "until": 2.5,
                  "motion": [{"at": 1}, {"at": 3, "translate": [1, 0, 2], "rotate": [0, 0, 2, 0]}]},
                 {"rect": {"center": [4, 5, 6], "size": [0.5, 0.25], "normal": [1, 0, 0], "up": [0, 3, 0]}, "speed": 2}],
    "drains": [{"name": "plug", "box": {"max": [1, 2, 3]}, "from": 0.5, "until": 9}, {"sphere": {"radius": 2}}],
    "probes": [{"name": "in", "flow": "tap"}, {"name": "out", "flow": "plug"}]})");
  EXPECT_EQ(s.fluid.capacity, 5000U);
  EXPECT_TRUE(s.domain->open_removes);
  ASSERT_EQ(s.emitters.size(), 2U);
  const Emitter &tap = s.emitters[0], &slot = s.emitters[1];
  EXPECT_EQ(tap.name, "tap");
  const auto& disc = std::get<DiscMouth>(tap.mouth);
  EXPECT_EQ(disc.center, (Double3{1, 2, 3}));
  EXPECT_EQ(disc.radius, 0.5);
  EXPECT_EQ(disc.normal, (Double3{0, -2, 0}));
  EXPECT_EQ(tap.flow, 0.25);
  EXPECT_EQ(tap.speed, 0);
  EXPECT_EQ(tap.from, 1);
  EXPECT_EQ(tap.until, 2.5);
  const auto& rect = std::get<RectMouth>(slot.mouth);
  EXPECT_EQ(rect.center, (Double3{4, 5, 6}));
  EXPECT_EQ(rect.size, (std::pair{0.5, 0.25}));
  EXPECT_EQ(rect.normal, (Double3{1, 0, 0}));
  EXPECT_EQ(rect.up, (Double3{0, 3, 0}));
  EXPECT_EQ(slot.speed, 2);
  EXPECT_EQ(slot.flow, 0);
  EXPECT_TRUE(slot.motion.empty());
  ASSERT_EQ(tap.motion.size(), 2U);
  EXPECT_EQ(tap.motion[1].at, 3);
  EXPECT_EQ(tap.motion[1].translate, (Double3{1, 0, 2}));
  EXPECT_EQ(tap.motion[1].rotate, (Quaternion{0, 0, 1, 0})) << "normalized";
  EXPECT_FALSE(slot.until);
  ASSERT_EQ(s.drains.size(), 2U);
  EXPECT_EQ(s.drains[0].name, "plug");
  EXPECT_EQ(std::get<BoxShape>(s.drains[0].shape).max, (Double3{1, 2, 3}));
  EXPECT_EQ(s.drains[0].from, 0.5);
  EXPECT_EQ(s.drains[0].until, 9);
  EXPECT_EQ(std::get<SphereShape>(s.drains[1].shape).radius, 2);
  EXPECT_EQ(s.probes[0].flow, "tap");
  EXPECT_EQ(s.probes[1].flow, "plug");
}

TEST(FlowScene, IsEmptyByDefault) {
  const Scene s = scene(R"({"rill": "0.2", "domain": {}, "fluid": {"spacing": 0.1}})");
  EXPECT_TRUE(s.emitters.empty() && s.drains.empty());
  EXPECT_EQ(s.fluid.capacity, 0U);
  EXPECT_FALSE(s.domain->open_removes);
}

TEST(FlowScene, NeedsVersion02) {
  const std::string needs = ": the scene says \"rill\": \"0.1\"; the key needs \"rill\": \"0.2\"";
  expectRefusals({
      {with(R"("emitters": [])"), "emitters" + needs},
      {with(R"("drains": [])"), "drains" + needs},
      {with(R"("domain": {"open": ["+y"], "open_removes": true})"), "domain.open_removes" + needs},
      {withFluid(R"("spacing": 0.1, "capacity": 100)"), "fluid.capacity" + needs},
      {with(R"("probes": [{"name": "p", "flow": "tap"}])"), "probes[0].flow" + needs},
  });
}

TEST(FlowScene, RejectsEmittersNamingTheKey) {
  EXPECT_EQ(parseError(emitter(R"("disc": {}, "flow": 1)")), "accepted");
  EXPECT_EQ(parseError(emitter(R"("rect": {}, "speed": 1)")), "accepted");
  const std::string mouths = "emitters[0]: expected exactly one of \"disc\", \"rect\", \"mesh\"; found ",
                    flows = "emitters[0]: expected exactly one of \"flow\", \"speed\"; found ";
  expectRefusals({
      {emitter(R"("flow": 1)"), mouths + "none"},
      {emitter(R"("disc": {}, "rect": {}, "flow": 1)"), mouths + "\"disc\", \"rect\""},
      {emitter(R"("disc": {})"), flows + "none"},
      {emitter(R"("disc": {}, "flow": 1, "speed": 1)"), flows + "\"flow\", \"speed\""},
      {emitter(R"("disc": {}, "flow": 0)"), "emitters[0].flow: 0 is out of range; expected a number above 0 (m^3/s)"},
      {emitter(R"("disc": {}, "speed": -1)"), "emitters[0].speed: -1 is out of range; expected a number above 0 (m/s)"},
      {emitter(R"("disc": {}, "speed": "inf")"),
       "emitters[0].speed: found the string \"inf\", which is not finite; expected a number above 0 (m/s)"},
      {emitter(R"("disc": {"radius": 0}, "flow": 1)"), "emitters[0].disc.radius: 0 is out of range; expected a number above 0 (m)"},
      {emitter(R"("disc": {"normal": [0, 0, 0]}, "flow": 1)"),
       "emitters[0].disc.normal: found a vector of zero length, expected a direction"},
      {emitter(R"("disc": {"normals": [0, 0, 1]}, "flow": 1)"), "emitters[0].disc.normals: unknown key; did you mean \"normal\"?"},
      {emitter(R"("rect": {"size": [1, 0]}, "flow": 1)"), "emitters[0].rect.size[1]: 0 is out of range; expected a number above 0 (m)"},
      {emitter(R"("rect": {"size": 1}, "flow": 1)"), "emitters[0].rect.size: found 1, expected 2 numbers [width, height] (m)"},
      {emitter(R"("rect": {"normal": [0, 0, 0]}, "flow": 1)"),
       "emitters[0].rect.normal: found a vector of zero length, expected a direction"},
      {emitter(R"("rect": {"up": [0, 0, 0]}, "flow": 1)"), "emitters[0].rect.up: found a vector of zero length, expected a direction"},
      {emitter(R"("rect": {"normal": [1, 2, 3], "up": [-2, -4, -6]}, "flow": 1)"),
       "emitters[0].rect.up: found [-2, -4, -6], which is parallel to the normal; expected another direction"},
      {emitter(R"("disc": {}, "flow": 1, "from": -1)"), "emitters[0].from: -1 is out of range; expected a number of at least 0 (s)"},
      {emitter(R"("disc": {}, "flow": 1, "from": 2, "until": 2)"), "emitters[0].until: found 2 s, expected a time later than from, 2 s"},
      {emitter(R"("disc": {}, "flow": 1, "until": 0)"), "emitters[0].until: 0 is out of range; expected a number above 0 (s)"},
      {emitter(R"("disc": {}, "flow": 1, "until": "auto")"), "emitters[0].until: found the string \"auto\", expected a number above 0 (s)"},
      {emitter(R"("disc": {}, "flow": 1, "motion": [{"at": 2}, {"at": 2}])"),
       "emitters[0].motion[1].at: found 2 s after 2 s in the previous entry, expected increasing times"},
      {emitter(R"("disc": {}, "flow": 1, "motion": [{"at": -1}])"),
       "emitters[0].motion[0].at: -1 is out of range; expected a number of at least 0 (s)"},
      {emitter(R"("disc": {}, "flow": 1, "motion": [{"at": 0, "rotate": [0, 0, 0, 0]}])"),
       "emitters[0].motion[0].rotate: the quaternion has zero length; expected a non-zero quaternion, [0, 0, 0, 1] for no rotation"},
      {emitter(R"("disc": {}, "flow": 1, "motion": [{"at": 0, "scale": 2}])"),
       "emitters[0].motion[0].scale: unknown key; did you mean \"fill[].mesh.scale\"?"},
      {list("emitters", R"({"disc": {}, "flow": 1})", 257), "emitters: found 257 entries, expected at most 256"},
  });
  EXPECT_EQ(parseError(list("emitters", R"({"disc": {}, "flow": 1})", 256)), "accepted");
}

TEST(FlowScene, AcceptsDirectionsOfAnyLength) {
  EXPECT_EQ(parseError(emitter(R"("rect": {"normal": [0, 1e38, 0], "up": [1e-40, 0, 0]}, "flow": 1)")), "accepted");
  EXPECT_EQ(parseError(emitter(R"("rect": {"normal": [0, -1, 0], "up": [0, 1, 0.001]}, "flow": 1)")), "accepted");
}

TEST(FlowScene, RejectsDrainsNamingTheKey) {
  EXPECT_EQ(parseError(drain(R"("sphere": {"radius": 1})")), "accepted");
  const std::string shapes = "drains[0]: expected exactly one of \"box\", \"sphere\"; found ";
  expectRefusals({
      {drain(""), shapes + "none"},
      {drain(R"("box": {}, "sphere": {})"), shapes + "\"box\", \"sphere\""},
      {drain(R"("box": {"max": [1, 0, 1]})"), "drains[0].box.max[1]: max is 0 and min is 0 along y; expected min below max on every axis"},
      {drain(R"("sphere": {"radius": 0})"), "drains[0].sphere.radius: 0 is out of range; expected a number above 0 (m)"},
      {drain(R"("box": {}, "from": 3, "until": 1)"), "drains[0].until: found 1 s, expected a time later than from, 3 s"},
      {drain(R"("box": {}, "flow": 1)"), "drains[0].flow: unknown key; did you mean \"emitters[].flow\"?"},
      {list("drains", R"({"box": {}})", 257), "drains: found 257 entries, expected at most 256"},
  });
  EXPECT_EQ(parseError(list("drains", R"({"box": {}})", 256)), "accepted");
}

TEST(FlowScene, NamesAreUniqueAmongEmittersAndDrains) {
  const std::string tap = R"({"name": "tap", "disc": {}, "flow": 1})", nameless = R"({"disc": {}, "flow": 1})";
  const std::string unique = "; expected unique names among emitters and drains";
  EXPECT_EQ(parseError(scene02("\"emitters\": [" + nameless + "," + tap + "," + nameless + R"(], "drains": [{"box": {}}, {"box": {}}])")),
            "accepted");
  expectRefusals({
      {scene02("\"emitters\": [" + tap + "," + tap + "]"), "emitters[1].name: \"tap\" is also the name of emitters[0]" + unique},
      {scene02("\"emitters\": [" + nameless + "," + tap + R"(], "drains": [{"name": "tap", "box": {}}])"),
       "drains[0].name: \"tap\" is also the name of emitters[1]" + unique},
  });
  EXPECT_EQ(parseError(scene02("\"emitters\": [" + tap + R"(], "solids": [{"name": "tap", "sphere": {}}])")), "accepted");
}

TEST(FlowScene, ProbesNameAnEmitterOrADrain) {
  const std::string probe = R"("probes": [{"name": "rate", "flow": "tpa"}])";
  expectRefusals({
      {scene02(probe),
       "probes[0].flow: no emitter or drain is named \"tpa\"; expected the name of an emitter or a drain, but no emitter or "
       "drain has one"},
      {scene02(R"("emitters": [{"name": "tap", "disc": {}, "flow": 1}], "drains": [{"name": "plug", "box": {}}], )" + probe),
       "probes[0].flow: no emitter or drain is named \"tpa\"; expected one of \"tap\", \"plug\"; did you mean \"tap\"?"},
      {scene02(R"("solids": [{"name": "tpa", "box": {}}], )" + probe),
       "probes[0].flow: no emitter or drain is named \"tpa\"; expected the name of an emitter or a drain, but no emitter or drain has one"},
      {scene02(R"("probes": [{"name": "rate", "flow": ""}])"),
       "probes[0]: found an empty name, expected the name of a solid, an emitter or a drain"},
      {scene02(R"("emitters": [{"name": "tap", "disc": {}, "flow": 1}], "probes": [{"name": "rate", "flow": "tap", "load": "tap"}])"),
       "probes[0]: expected exactly one of \"level\", \"front\", \"load\", \"pose\", \"pressure\", \"flow\"; found \"load\", \"flow\""},
  });
}

TEST(FlowScene, OpenSidesRemoveOnlyWhereASideIsOpen) {
  const std::string why = ": found true, but no side is open; expected sides in \"open\", or false";
  EXPECT_EQ(parseError(scene02(R"("domain": {"open_removes": false})")), "accepted");
  EXPECT_EQ(parseError(scene02(R"("domain": {"open_removes": true})")), "dam.json: domain.open_removes" + why);
  const std::string open = scene02(R"("domain": {"open": ["+y"], "open_removes": true})");
  EXPECT_EQ(parseError(open), "accepted");
  EXPECT_EQ(parseError(open, {{"domain.open", "[]"}}), "--set domain.open" + why);
}

TEST(FlowScene, ReadsInflowAndOutflow) {
  const Scene s =
      scene(scene02(R"("domain": {"inflow": {"side": "+z", "level": 0.25, "flow": 2}, "outflow": {"side": "-x", "level": 0.5}})"));
  EXPECT_EQ(s.domain->inflow->side, Axis::PlusZ);
  EXPECT_EQ(s.domain->inflow->level, 0.25);
  EXPECT_EQ(s.domain->inflow->flow, 2);
  EXPECT_EQ(s.domain->outflow->side, Axis::MinusX);
  EXPECT_EQ(s.domain->outflow->level, 0.5);
  const std::vector<Emitter> all = emittersOf(s);
  ASSERT_EQ(all.size(), 1U);
  const auto& mouth = std::get<RectMouth>(all[0].mouth);
  EXPECT_EQ(mouth.center, (Double3{0.5, 0.125, 0.95})) << "the first centers are half a spacing off the wall";
  EXPECT_EQ(mouth.size, (std::pair{1.0, 0.25}));
  EXPECT_EQ(mouth.normal, (Double3{0, 0, -1}));
  EXPECT_EQ(parseError(scene02(R"("domain": {"inflow": {"level": 0.5, "speed": 1}}, "probes": [{"name": "q", "flow": "inflow"}])")),
            "accepted");
}

TEST(FlowScene, RejectsInflowsAndOutflowsNamingTheKey) {
  const auto inflow = [](const std::string& keys) { return scene02(R"("domain": {"inflow": {)" + keys + "}}"); };
  expectRefusals({
      {inflow(R"("level": 0.5)"), "domain.inflow: expected exactly one of \"flow\", \"speed\"; found none"},
      {inflow(R"("level": 0.5, "speed": 1, "side": "+y")"),
       "domain.inflow.side: found a side across y, expected one of \"-x\", \"+x\", \"-z\", \"+z\""},
      {inflow(R"("level": 1, "speed": 1)"), "domain.inflow.level: found 1, expected a level below the domain's height, 1 (m)"},
      {scene02(R"("domain": {"open": ["-x"], "inflow": {"level": 0.5, "speed": 1}})"),
       "domain.inflow.side: found an open side, expected a closed one"},
      {scene02(R"("domain": {"inflow": {"level": 0.5, "speed": 1}, "outflow": {"side": "-x", "level": 0.5}})"),
       "domain.outflow.side: found the side of the inflow, expected another one"},
      {scene02(R"("domain": {"inflow": {"level": 0.5, "speed": 1}}, "drains": [{"name": "inflow", "box": {}}])"),
       "drains[0].name: \"inflow\" is also the name of domain.inflow; expected unique names among emitters and drains"},
  });
}

TEST(FlowScene, RejectsCapacitiesOutOfRange) {
  const auto capacity = [](const std::string& value) { return R"({"rill": "0.2", "fluid": {"spacing": 0.1, "capacity": )" + value + "}}"; };
  EXPECT_EQ(parseError(capacity("67108864")), "accepted");
  EXPECT_EQ(scene(capacity("0")).fluid.capacity, 0U);
  expectRefusals({
      {capacity("67108865"), "fluid.capacity: 67108865 is out of range; expected a whole number from 0 to 67108864"},
      {capacity("1.5"), "fluid.capacity: found 1.5, expected a whole number from 0 to 67108864"},
      {capacity("-1"), "fluid.capacity: -1 is out of range; expected a whole number from 0 to 67108864"},
  });
}

TEST(FlowScene, OverridesSetEveryKindOfKey) {
  const std::string base = scene02(R"("emitters": [{"name": "tap", "disc": {}, "flow": 1}], "drains": [{"box": {}}], "domain": {})");
  const Scene s = scene(base, {{"emitters[0].flow", "0.002"},
                               {"emitters[0].until", "4"},
                               {"emitters[0].disc.radius", "0.05"},
                               {"emitters[1]", R"({"rect": {}, "speed": 1})"},
                               {"emitters[1].rect.size", "[0.5, 0.25]"},
                               {"drains[0].until", "3"},
                               {"drains[0].name", "plug"},
                               {"domain.open", "[\"-y\"]"},
                               {"domain.open_removes", "true"},
                               {"fluid.capacity", "777"},
                               {"probes", R"([{"name": "p", "flow": "plug"}])"}});
  EXPECT_EQ(s.emitters[0].flow, 0.002);
  EXPECT_EQ(s.emitters[0].until, 4);
  EXPECT_EQ(std::get<DiscMouth>(s.emitters[0].mouth).radius, 0.05);
  EXPECT_EQ(std::get<RectMouth>(s.emitters[1].mouth).size, (std::pair{0.5, 0.25}));
  EXPECT_EQ(s.drains[0].until, 3);
  EXPECT_EQ(s.drains[0].name, "plug");
  EXPECT_TRUE(s.domain->open_removes);
  EXPECT_EQ(s.fluid.capacity, 777U);
  EXPECT_EQ(s.probes[0].flow, "plug");
  EXPECT_EQ(parseError(base, {{"emitters[0].flow", "-1"}}),
            "--set emitters[0].flow: -1 is out of range; expected a number above 0 (m^3/s)");
  EXPECT_EQ(parseError(base, {{"emitters[0].from", "2"}, {"emitters[0].until", "1"}}),
            "--set emitters[0].until: found 1 s, expected a time later than from, 2 s");
  EXPECT_EQ(parseError(scene02(R"("drains": [{"box": {}, "until": 1}])"), {{"drains[0].from", "1"}}),
            "--set drains[0].from: found 1 s, expected a time later than from, 1 s");
  EXPECT_EQ(parseError(base, {{"emitters[0].speed", "1"}}),
            "--set emitters[0].speed: expected exactly one of \"flow\", \"speed\"; found \"flow\", \"speed\"");
}

}  // namespace
}  // namespace rill::test
