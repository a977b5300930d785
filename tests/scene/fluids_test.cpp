// Scenes with several fluids: their keys and what is refused.
#include "fill/mouth.hpp"
#include "two_fluids.hpp"

namespace rill::test {
namespace {

/// A scene with one oil whose other keys are these.
std::string withOil(const std::string& keys) { return fluidScene(R"("fluids": [{"name": "oil", )" + keys + "}]"); }

TEST(FluidsScene, ReadsMaterialsAndTakesMissingKeysFromFluid) {
  const Scene s = scene(fluidScene(kTwoFluids + R"(, "fill": [{"box": {}}, {"sphere": {}, "fluid": "oil"}])"));
  const std::vector<ResolvedFluid> fluids = resolvedFluids(s);
  ASSERT_EQ(fluids.size(), 2U);
  EXPECT_EQ(fluids[0].name, "water");
  EXPECT_EQ(fluids[0].density, 998);
  EXPECT_EQ(fluids[0].viscosity, 0.001);
  EXPECT_FALSE(fluids[0].color);
  EXPECT_EQ(fluids[1].name, "oil");
  EXPECT_EQ(fluids[1].density, 900);
  EXPECT_EQ(fluids[1].viscosity, 0.05);
  EXPECT_EQ(fluids[1].color, (Double3{0.8, 0.6, 0.1}));
  EXPECT_EQ(fluidIndex(s, s.fill[0].fluid), 0U);
  EXPECT_EQ(fluidIndex(s, s.fill[1].fluid), 1U);
  EXPECT_EQ(fluidIndex(s, "tar"), kMaxFluids);
}

TEST(FluidsScene, WithoutFluidsHasOneOfTheMaterialOfFluid) {
  const Scene s = scene(fluidScene(R"("fluids": [])"));
  const std::vector<ResolvedFluid> fluids = resolvedFluids(s);
  ASSERT_EQ(fluids.size(), 1U);
  EXPECT_EQ(fluids[0].name, "fluid");
  EXPECT_EQ(fluids[0].density, 998);
}

TEST(FluidsScene, KnowsWhichFluidsDiffuse) {
  const Scene s =
      scene(fluidScene(R"("fluids": [{"name": "water"}, {"name": "milk", "diffusion": 1e-5}, {"name": "ink", "diffusion": 1}])"));
  EXPECT_EQ(diffusingFluids(s), (std::vector<size_t>{1, 2}));
  EXPECT_EQ(resolvedFluids(s)[1].diffusion, 1e-5);
  EXPECT_TRUE(diffusingFluids(scene(fluidScene(R"("fluids": [{"name": "milk", "diffusion": 1e-5}])"))).empty()) << "there is no other";
}

TEST(FluidsScene, EmittersAndInflowHaveAFluid) {
  const Scene s = scene(fluidScene(kTwoFluids + R"(, "emitters": [{"disc": {}, "flow": 1, "fluid": "oil"}, {"disc": {}, "flow": 1}],
    "domain": {"inflow": {"level": 0.5, "speed": 1, "fluid": "oil"}})"));
  const std::vector<Emitter> all = emittersOf(s);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(fluidIndex(s, all[0].fluid), 1U);
  EXPECT_EQ(fluidIndex(s, all[1].fluid), 0U);
  EXPECT_EQ(fluidIndex(s, all[2].fluid), 1U) << "the inflow";
}

TEST(FluidsScene, RejectsInvalidMaterialsNamingTheKey) {
  EXPECT_EQ(parseError(withOil(R"("viscosity": 0, "color": [0, 1, 0.5])")), "accepted");
  expectRefusals({
      {fluidScene(R"("fluids": [{"name": "oil"}, {"name": "oil"}])"),
       "fluids[1].name: \"oil\" is also the name of fluids[0]; expected unique names"},
      {fluidScene(R"("fluids": [{"density": 900}])"), "fluids[0].name: required key is missing: name of the fluid; unique, not empty"},
      {fluidScene(R"("fluids": [{"name": ""}])"), "fluids[0].name: found an empty name, expected a unique name"},
      {withOil(R"("density": 0)"), "fluids[0].density: 0 is out of range; expected a number above 0 (kg/m^3)"},
      {withOil(R"("density": -900)"), "fluids[0].density: -900 is out of range; expected a number above 0 (kg/m^3)"},
      {withOil(R"("density": "auto")"), "fluids[0].density: found the string \"auto\", expected a number above 0 (kg/m^3)"},
      {withOil(R"("density": 1e-36)"),
       "fluids[0].density: the mass of a particle, density x spacing^3, is 1e-39 kg; expected a mass that fits a 32-bit float"},
      {withOil(R"("viscosity": -0.1)"), "fluids[0].viscosity: -0.1 is out of range; expected a number of at least 0 (Pa s)"},
      {withOil(R"("yield_stress": -1)"), "fluids[0].yield_stress: -1 is out of range; expected a number of at least 0 (Pa)"},
      {withOil(R"("flow_index": 2.5)"), "fluids[0].flow_index: 2.5 is out of range; expected a number from 0.2 to 2"},
      {withOil(R"("diffusion": -1e-9)"), "fluids[0].diffusion: -1e-09 is out of range; expected a number of at least 0 (m^2/s)"},
      {fluidScene(R"("fluids": [{"name": "1", "diffusion": 1}, {"name": "2"}, {"name": "3", "diffusion": 1}, {"name": "4", "diffusion": 1},
         {"name": "5", "diffusion": 1}, {"name": "6", "diffusion": 0.5}])"),
       "fluids[5].diffusion: found 0.5 m^2/s in a fifth fluid; expected a diffusion above 0 in at most 4"},
      {withOil(R"("color": [0, 1.5, 0])"), "fluids[0].color[1]: 1.5 is out of range; expected a number from 0 to 1"},
      {withOil(R"("color": [0, 1, -0.5])"), "fluids[0].color[2]: -0.5 is out of range; expected a number from 0 to 1"},
      {withOil(R"("color": [0, 1])"), "fluids[0].color: found an array of length 2, expected 3 numbers [red, green, blue]"},
      {withOil(R"("spacing": 0.1)"), "fluids[0].spacing: unknown key; did you mean \"fluid.spacing\"?"},
      {withOil(R"("densty": 900)"), "fluids[0].densty: unknown key; did you mean \"density\"?"},
      {fluidScene(R"("fluids": {"oil": {}})"), "fluids: found an object, expected a list of objects"},
  });
}

TEST(FluidsScene, RejectsMoreThanEight) {
  std::string list;
  for (int i = 0; i < 8; ++i) list += R"({"name": "fluid )" + std::to_string(i) + "\"},";
  EXPECT_EQ(parseError(fluidScene("\"fluids\": [" + list.substr(0, list.size() - 1) + "]")), "accepted");
  EXPECT_EQ(parseError(fluidScene("\"fluids\": [" + list + R"({"name": "ninth"}])")),
            "dam.json: fluids: found 9 entries, expected at most 8");
}

TEST(FluidsScene, ReadsInterfaces) {
  const Scene s =
      scene(fluidScene(kTwoFluids + R"(, "interfaces": [{"between": ["oil", "water"], "tension": 0.02}], "fill": [{"box": {}}])"));
  ASSERT_EQ(s.interfaces.size(), 1U);
  EXPECT_EQ(s.interfaces[0].between, std::pair(std::string("oil"), std::string("water")));
  EXPECT_EQ(s.interfaces[0].tension, 0.02);
}

TEST(FluidsScene, RejectsInvalidInterfaces) {
  const std::string one = "; expected one of \"water\", \"oil\"";
  const auto with = [&](const std::string& entries) { return fluidScene(kTwoFluids + ", \"interfaces\": [" + entries + "]"); };
  expectRefusals({
      {with(R"({"between": ["oil", "wate"], "tension": 1})"),
       "interfaces[0].between[1]: no fluid is named \"wate\"" + one + "; did you mean \"water\"?"},
      {with(R"({"between": ["oil", "oil"], "tension": 1})"), "interfaces[0].between: found \"oil\" twice; expected two fluids"},
      {with(R"({"between": ["oil", "water"]}, {"between": ["water", "oil"]})"),
       "interfaces[1].between: \"water\" and \"oil\" are also those of interfaces[0]; expected each pair once"},
      {with(R"({"between": ["oil", "water"], "tension": -1})"),
       "interfaces[0].tension: -1 is out of range; expected a number of at least 0 (N/m)"},
      {with(R"({"between": ["oil"]})"), "interfaces[0].between: found an array of length 1, expected 2 names"},
      {with(R"({"between": ["oil", 3]})"), "interfaces[0].between[1]: found 3, expected a string"},
      {with(R"({"between": "oil"})"), "interfaces[0].between: found the string \"oil\", expected 2 names"},
      {with(R"({"tension": 1})"), "interfaces[0].between: required key is missing: names of two of fluids"},
      {fluidScene(R"("interfaces": [{"between": ["oil", "water"]}])"),
       "interfaces: the scene has no \"fluids\"; expected two or more there, or no interfaces"},
  });
}

TEST(FluidsScene, RejectsUnknownFluids) {
  const std::string one = "; expected one of \"water\", \"oil\"", oil = "; did you mean \"oil\"?";
  const std::string tap = R"("emitters": [{"disc": {}, "flow": 1, "fluid": "oli"}])";
  const std::string none = ", but the scene has no \"fluids\"; expected a fluid of that name there, or no key";
  expectRefusals({
      {fluidScene(kTwoFluids + R"(, "fill": [{"box": {}}, {"box": {}, "fluid": "oli"}])"),
       "fill[1].fluid: no fluid is named \"oli\"" + one + oil},
      {fluidScene(kTwoFluids + R"(, "fill": [{"box": {}, "fluid": "mercury"}])"), "fill[0].fluid: no fluid is named \"mercury\"" + one},
      {fluidScene(kTwoFluids + ", " + tap), "emitters[0].fluid: no fluid is named \"oli\"" + one + oil},
      {fluidScene(kTwoFluids + R"(, "domain": {"inflow": {"level": 0.5, "speed": 1, "fluid": "Water"}})"),
       "domain.inflow.fluid: no fluid is named \"Water\"" + one + "; did you mean \"water\"?"},
      {fluidScene(R"("fill": [{"box": {}, "fluid": "oil"}])"), "fill[0].fluid: found \"oil\"" + none},
      {fluidScene(tap), "emitters[0].fluid: found \"oli\"" + none},
      {fluidScene(kTwoFluids + R"(, "fill": [{"box": {}, "fluid": 1}])"), "fill[0].fluid: found 1, expected a string"},
  });
}

TEST(FluidsScene, RejectsEmptyFluidNames) {
  const std::string expected = "found \"\", expected one of \"water\", \"oil\", or no key";
  expectRefusals({
      {fluidScene(kTwoFluids + R"(, "fill": [{"box": {}, "fluid": "oil"}, {"box": {}, "fluid": ""}])"), "fill[1].fluid: " + expected},
      {fluidScene(kTwoFluids + R"(, "emitters": [{"disc": {}, "flow": 1, "fluid": ""}])"), "emitters[0].fluid: " + expected},
      {fluidScene(kTwoFluids + R"(, "domain": {"inflow": {"level": 0.5, "speed": 1, "fluid": ""}})"), "domain.inflow.fluid: " + expected},
      {fluidScene(R"("fill": [{"box": {}, "fluid": ""}])"), "fill[0].fluid: found \"\", but the scene has no \"fluids\"; expected no key"},
  });
  EXPECT_EQ(parseError(fluidScene(kTwoFluids + R"(, "fill": [{"box": {}}])"), {{"fill[0].fluid", ""}}), "--set fill[0].fluid: " + expected);
}

// `fluid` is a key elsewhere, of another kind: drains take any fluid, and probes read any.
TEST(FluidsScene, SuggestsNoKeyOfAnotherKindForFluid) {
  expectRefusals({
      {fluidScene(kTwoFluids + R"(, "drains": [{"box": {}, "fluid": "oil"}])"),
       "drains[0].fluid: unknown key; expected one of \"name\", \"box\", \"sphere\", \"from\", \"until\""},
      {fluidScene(kTwoFluids + R"(, "probes": [{"name": "p", "level": [0, 0], "fluid": "oil"}])"),
       "probes[0].fluid: unknown key; expected one of \"name\", \"level\", \"front\", \"load\", \"pose\", \"pressure\", \"flow\""},
      {fluidScene(R"("solver": {"fluid": {"spacing": 0.1}})"),
       "solver.fluid: unknown key; did you mean \"fluid\", at the top of the scene?"},
  });
}

TEST(FluidsScene, KeysNeedVersion02) {
  const std::string needs = ": the scene says \"rill\": \"0.1\"; the key needs \"rill\": \"0.2\"";
  EXPECT_EQ(parseError(with(kTwoFluids)), "dam.json: fluids" + needs);
  EXPECT_EQ(parseError(with(R"("fill": [{"box": {}, "fluid": "oil"}])")), "dam.json: fill[0].fluid" + needs);
  EXPECT_EQ(parseError(with(R"("duration": 1)"), {{"fluids[0].name", "oil"}}), "--set fluids[0].name: fluids" + needs);
}

TEST(FluidsScene, OverridesAddressFluidsByNameAndIndex) {
  const std::string base = fluidScene(kTwoFluids + R"(, "fill": [{"box": {}}], "solids": [{"box": {}}, {"name": "post", "box": {}}])");
  const Scene s = scene(base, {{"fluids.oil.density", "870"},
                               {"fluids[0].viscosity", "0.002"},
                               {"fluids[2]", R"({"name": "tar", "density": 1200})"},
                               {"fluids.tar.viscosity", "100"},
                               {"fill[0].fluid", "tar"},
                               {"solids.post.friction", "0.5"}});
  EXPECT_EQ(s.fluids[1].density, 870);
  EXPECT_EQ(s.fluids[0].viscosity, 0.002);
  EXPECT_EQ(s.fluids[2].viscosity, 100);
  EXPECT_EQ(fluidIndex(s, s.fill[0].fluid), 2U);
  EXPECT_EQ(s.solids[1].friction, 0.5);
}

TEST(FluidsScene, OverridesOfUnknownFluidsAreRejected) {
  const std::string base = fluidScene(kTwoFluids + R"(, "fill": [{"box": {}}])");
  EXPECT_EQ(parseError(base, {{"fluids.oyl.density", "1"}}),
            "--set fluids.oyl.density: no entry of fluids is named \"oyl\"; expected one of \"water\", \"oil\", or an index, as in "
            "fluids[0]; did you mean \"oil\"?");
  EXPECT_EQ(parseError(base, {{"fill.oil.fluid", "1"}}),
            "--set fill.oil.fluid: no entry of fill is named \"oil\"; expected an index, as in fill[0]");
  EXPECT_EQ(parseError(fluidScene(R"("duration": 1)"), {{"fluids.oil.density", "1"}}),
            "--set fluids.oil.density: the scene has no \"fluids\"; expected an index, as in fluids[0] (which adds an entry)");
  EXPECT_EQ(parseError(base, {{"fluids.oil.density", "-1"}}),
            "--set fluids.oil.density: fluids[1].density: -1 is out of range; expected a number above 0 (kg/m^3)");
  EXPECT_EQ(parseError(base, {{"fill[0].fluid", "oyl"}}),
            "--set fill[0].fluid: no fluid is named \"oyl\"; expected one of \"water\", \"oil\"; did you mean \"oil\"?");
}

TEST(FluidsScene, CheckSceneAppliesTheSameRules) {
  const auto message = [](const Scene& s) {
    const auto checked = checkScene(s);
    return checked ? std::string("accepted") : checked.error().message;
  };
  Scene s;
  s.fluid.spacing = 0.1;
  s.fluids = {{.name = "water"}, {.name = "oil", .density = 900, .color = Double3{1, 0.5, 0}}};
  s.fill = {{.shape = BoxShape{}, .fluid = "oil"}};
  EXPECT_EQ(message(s), "accepted");
  s.fluids[1].density = 0;
  EXPECT_EQ(message(s), "fluids[1].density: 0 is out of range; expected a number above 0 (kg/m^3)");
  s.fluids[1].density = 900;
  s.fluids[1].color->y = 2;
  EXPECT_EQ(message(s), "fluids[1].color[1]: 2 is out of range; expected a number from 0 to 1");
  s.fluids[1] = {.name = "water"};
  EXPECT_EQ(message(s), "fluids[1].name: \"water\" is also the name of fluids[0]; expected unique names");
  s.fluids.pop_back();
  EXPECT_EQ(message(s), "fill[0].fluid: no fluid is named \"oil\"; expected one of \"water\"");
  s.fill[0].fluid = "";
  s.fluids.resize(9);
  EXPECT_EQ(message(s), "fluids: found 9 entries, expected at most 8");
}

}  // namespace
}  // namespace rill::test
