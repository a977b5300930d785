// Scenes that are refused for their keys and values, with the message.
#include "support.hpp"

namespace rill::test {
namespace {

TEST(SceneErrors, RejectsInvalidAndNewerVersions) {
  const auto version = [](const std::string& value) { return R"({"rill": )" + value + R"(, "unknown": 1, "fluid": {"spacing": 0.1}})"; };
  const std::string expected = "expected the minimum Rill version, for example \"0.1\"";
  expectRefusals({
      {R"({"fluid": {"spacing": 0.1}})", "rill: missing; " + expected},
      {version("0.1"), "rill: found 0.1, expected a string"},
      {version(R"("")"), "rill: found \"\", " + expected},
      {version(R"("1")"), "rill: found \"1\", " + expected},
      {version(R"("0.1.")"), "rill: found \"0.1.\", " + expected},
      {version(R"("0.1.2.3")"), "rill: found \"0.1.2.3\", " + expected},
      {version(R"("v0.1")"), "rill: found \"v0.1\", " + expected},
  });
  for (const std::string value : {"999.0", "0.3", "0.999", "999.1.2", "99999999999999999999.0"}) {
    EXPECT_EQ(
        parseError(version("\"" + value + "\"")).rfind("dam.json: rill: the scene needs Rill " + value + " or later; this is Rill ", 0), 0U)
        << value;
  }
  for (const std::string value : {"0.1", "0.2", "0.0", "0.1.0", "0.2.0", "0.0.99", "00.01"})
    EXPECT_EQ(parseError(R"({"rill": ")" + value + R"(", "fluid": {"spacing": 1}})"), "accepted") << value;
}

TEST(SceneErrors, RejectsBodiesNamingTheKey) {
  const auto body = [](const std::string& keys, const std::string& more = "") {
    return R"({"rill": "0.2", "fluid": {"spacing": 0.1}, "solids": [{"box": {}, "body": {)" + keys + "}" + more + "}]}";
  };
  EXPECT_EQ(parseError(body(R"("density": 500, "locked": ["x", "rz"])")), "accepted");
  expectRefusals({
      {body(R"("density": 0)"), "solids[0].body.density: 0 is out of range; expected a number above 0 (kg/m^3)"},
      {body(""), "solids[0].body: expected exactly one of \"density\", \"mass\"; found none"},
      {body(R"("density": 500, "mass": 2)"), "solids[0].body: expected exactly one of \"density\", \"mass\"; found \"density\", \"mass\""},
      {body(R"("mass": 2, "locked": ["w"])"),
       "solids[0].body.locked[0]: found the string \"w\", expected one of \"x\", \"y\", \"z\", \"rx\", \"ry\", \"rz\""},
      {body(R"("mass": 2, "locked": ["x", "x"])"), "solids[0].body.locked[1]: \"x\" is given twice; expected each once"},
      {body(R"("mass": 2, "locked": ["ry"], "angular_velocity": [0, 1, 0])"),
       "solids[0].body.angular_velocity: found 1 along y, which is locked; expected 0"},
      {body(R"("mass": 2, "from": -1)"), "solids[0].body.from: -1 is out of range; expected a number of at least 0 (s)"},
      {body(R"("mass": 2)", R"(, "motion": [{"at": 0}])"),
       "solids[0].body: found a body with keyframes; expected \"body\" or \"motion\", not both"},
  });
}

TEST(SceneErrors, RejectsKeysNewerThanTheVersionOfTheScene) {
  const auto turning = [](const std::string& version, const std::string& key) {
    return R"({"rill": ")" + version + R"(", "fluid": {"spacing": 0.1}, "solids": [{"box": {}, "motion": [{"at": 0}, {"at": 1, )" + key +
           "}]}]}";
  };
  const std::string turn = R"("rotate": [0, 1, 0, 0])";
  EXPECT_EQ(parseError(turning("0.2", turn)), "accepted");
  EXPECT_EQ(parseError(turning("0.1", turn)),
            "dam.json: solids[0].motion[1].rotate: the scene says \"rill\": \"0.1\"; the key needs \"rill\": \"0.2\"");
  EXPECT_EQ(parseError(turning("0.1", turn), {{"rill", "0.2"}}), "accepted");
  EXPECT_EQ(parseError(with(R"("look": {"sky": "day"})")),
            "dam.json: look.sky: the scene says \"rill\": \"0.1\"; the key needs \"rill\": \"0.2\"");
  for (const char* seconds : {"-0.1", "1.5"})
    EXPECT_NE(parseError(R"({"rill": "0.2", "fluid": {"spacing": 0.1}, "look": {"spray_exposure": )" + std::string(seconds) + "}}")
                  .find("dam.json: look.spray_exposure: " + std::string(seconds) + " is out of range; expected a number from 0 to 1 (s)"),
              std::string::npos)
        << seconds;
  EXPECT_EQ(parseError(turning("0.1", "\"translate\": [1, 0, 0]"), {{"solids[0].motion[0].rotate", "[0,0,0,1]"}}),
            "--set solids[0].motion[0].rotate: the scene says \"rill\": \"0.1\"; the key needs \"rill\": \"0.2\"");
  EXPECT_EQ(
      parseError(turning("0.2", R"("rotate": [0, 0, 0, 0])")),
      "dam.json: solids[0].motion[1].rotate: the quaternion has zero length; expected a non-zero quaternion, [0, 0, 0, 1] for no rotation");
  EXPECT_EQ(parseError(turning("0.2", R"("rotate": [0, 0, 1])")),
            "dam.json: solids[0].motion[1].rotate: found an array of length 3, expected 4 numbers [x, y, z, w]");
}

TEST(SceneErrors, SuggestsNearestKeyForUnknownKeys) {
  expectRefusals({
      {withFluid(R"("spacing": 0.1, "viscosty": 1)"), "fluid.viscosty: unknown key; did you mean \"viscosity\"?"},
      {with(R"("Gravity": [0, 0, 0])"), ": Gravity: unknown key; did you mean \"gravity\"?"},
      {with(R"("viscosity": 1)"), "viscosity: unknown key; did you mean \"fluid.viscosity\"?"},
      {with(R"("solver": {"jitter": 1})"), "solver.jitter: unknown key; did you mean \"fill[].jitter\"?"},
      {with(R"("fill": [{"seed": 1}])"), "fill[0].seed: unknown key; did you mean \"seed\", at the top of the scene?"},
      {with(R"("fill": [{"box": {"min": [0, 0, 0], "mx": [1, 1, 1]}}])"), "fill[0].box.mx: unknown key; did you mean \"max\"?"},
      {with(R"("look": {"zzzzzz": 1})"),
       "look.zzzzzz: unknown key; expected one of \"preset\", \"surface\", \"sky\", \"stage\", \"environment\", "
       "\"whitewater\", \"spray_exposure\", \"caustics\""},
      {with(R"("look": {"a.b\nc": 1})"),
       "look.\"a.b\\u000ac\": unknown key; expected one of \"preset\", \"surface\", \"sky\", \"stage\", \"environment\", \"whitewater\", "
       "\"spray_exposure\", \"caustics\""},
  });
  EXPECT_EQ(parseError(with(R"("extras": {"anything": [1, {"goes": null}]}, "$schema": "scene.schema.json")")), "accepted");
}

TEST(SceneErrors, RejectsWrongTypesAndLengths) {
  expectRefusals({
      {R"({"rill": "0.1"})", "fluid: required key is missing: material and resolution of the fluid"},
      {R"({"rill": "0.1", "fluid": 3})", "fluid: found 3, expected an object"},
      {R"({"rill": "0.1", "fluid": {}})", "fluid: expected exactly one of \"spacing\", \"particles\"; found none"},
      {withFluid(R"("spacing": 0.1, "particles": 10)"),
       "fluid: expected exactly one of \"spacing\", \"particles\"; found \"spacing\", \"particles\""},
      {withFluid(R"("spacing": "wide")"), "fluid.spacing: found the string \"wide\", expected a number above 0 (m)"},
      {withFluid(R"("spacing": true)"), "fluid.spacing: found true, expected a number above 0 (m)"},
      {withFluid(R"("spacing": null)"), "fluid.spacing: found null, expected a number above 0 (m)"},
      {withFluid(R"("spacing": "NaN")"), "fluid.spacing: found the string \"NaN\", which is not finite; expected a number above 0 (m)"},
      {withFluid(R"("particles": 10.5)"), "fluid.particles: found 10.5, expected a whole number from 1 to 4294967295"},
      {with(R"("gravity": [0, 1])"), "gravity: found an array of length 2, expected 3 numbers [x, y, z] (m/s^2)"},
      {with(R"("gravity": -9.81)"), "gravity: found -9.81, expected 3 numbers [x, y, z] (m/s^2)"},
      {with(R"("gravity": [0, "down", 0])"), "gravity[1]: found the string \"down\", expected a number (m/s^2)"},
      {with(R"("title": 7)"), "title: found 7, expected a string"},
      {with(R"("seed": -1)"), "seed: -1 is out of range; expected a whole number from 0 to 18446744073709551615"},
      {with(R"("seed": 1.5)"), "seed: found 1.5, expected a whole number from 0 to 18446744073709551615"},
      {with(R"("seed": 18446744073709551616)"),
       "seed: 18446744073709551616 is out of range; expected a whole number from 0 to 18446744073709551615"},
      {with(R"("fill": {})"), "fill: found an object, expected a list of objects"},
      {with(R"("fill": [3])"), "fill[0]: found 3, expected an object"},
      {with(R"("domain": {"open": "+y"})"),
       "domain.open: found the string \"+y\", expected a list of some of \"-x\", \"+x\", \"-y\", \"+y\", \"-z\", \"+z\""},
      {with(R"("domain": {"open": ["y"]})"),
       "domain.open[0]: found the string \"y\", expected one of \"-x\", \"+x\", \"-y\", \"+y\", \"-z\", \"+z\""},
      {with(R"("domain": {"open": ["+y", "+y"]})"), "domain.open[1]: \"+y\" is given twice; expected each once"},
      {with(R"("solver": {"time_step": "atuo"})"),
       "solver.time_step: found the string \"atuo\", expected \"auto\" or a number above 0 (s)"},
      {with(R"("solver": {"kernel": "wendlnd"})"),
       "solver.kernel: found the string \"wendlnd\", expected one of \"wendland\", \"poly6_spiky\"; did you mean \"wendland\"?"},
      {with(R"("look": {"surface": "plane"})"),
       "look.surface: found the string \"plane\", expected one of \"auto\", \"planes\", \"curvature_flow\", \"narrow_range\"; did you "
       "mean "
       "\"planes\"?"},
      {with(R"("probes": [{"name": "p", "level": [1, 2, 3]}])"),
       "probes[0].level: found an array of length 3, expected 2 numbers [x, z] (m)"},
  });
}

TEST(SceneErrors, RejectsNumbersOutOfRange) {
  const auto solver = [](const std::string& keys) { return with(R"("solver": {)" + keys + "}"); };
  const auto solid = [](const std::string& keys) { return with(R"("solids": [{"sphere": {"radius": 1}, )" + keys + "}]"); };
  expectRefusals({
      {withFluid(R"("spacing": 0)"), "fluid.spacing: 0 is out of range; expected a number above 0 (m)"},
      {withFluid(R"("spacing": -1)"), "fluid.spacing: -1 is out of range; expected a number above 0 (m)"},
      {withFluid(R"("spacing": 1e39)"), "fluid.spacing: 1e+39 is out of range of a 32-bit float; expected a number above 0 (m)"},
      {withFluid(R"("spacing": 1e-50)"), "fluid.spacing: 1e-50 is out of range of a 32-bit float; expected a number above 0 (m)"},
      {withFluid(R"("spacing": 1e999)"), ":1:38: the number 1e999 is out of range; expected a number that fits a 32-bit float"},
      {withFluid(R"("spacing": 1e-20)"),
       "fluid.spacing: the mass of a particle, density x spacing^3, is 1e-57 kg; expected a mass that fits a 32-bit float"},
      {withFluid(R"("particles": 0)"), "fluid.particles: 0 is out of range; expected a whole number from 1 to 4294967295"},
      {withFluid(R"("spacing": 1, "smoothing_ratio": 1.1)"), "fluid.smoothing_ratio: 1.1 is out of range; expected a number from 1.2 to 4"},
      {withFluid(R"("spacing": 1, "tensile_radius": 1)"), "fluid.tensile_radius: 1 is out of range; expected a number above 0 and below 1"},
      {withFluid(R"("spacing": 1, "viscosity": -0.1)"), "fluid.viscosity: -0.1 is out of range; expected a number of at least 0 (Pa s)"},
      {with(R"("gravity": [0, -1e40, 0])"), "gravity[1]: -1e+40 is out of range of a 32-bit float; expected a number (m/s^2)"},
      {with(R"("duration": -1)"), "duration: -1 is out of range; expected a number of at least 0 (s)"},
      {solver(R"("cfl": 10.5)"), "solver.cfl: 10.5 is out of range; expected a number above 0 and at most 10"},
      {solver(R"("iterations": 0)"), "solver.iterations: 0 is out of range; expected a whole number from 1 to 1000"},
      {solver(R"("max_substeps": 257)"), "solver.max_substeps: 257 is out of range; expected a whole number from 1 to 256"},
      {solver(R"("relaxation": 2.1)"), "solver.relaxation: 2.1 is out of range; expected a number above 0 and at most 2"},
      {solver(R"("warm_start": 0.6)"), "solver.warm_start: 0.6 is out of range; expected a number from 0 to 0.5"},
      {solid(R"("restitution": 1.5)"), "solids[0].restitution: 1.5 is out of range; expected a number from 0 to 1"},
      {with(R"("camera": {"fov_y_deg": 180})"), "camera.fov_y_deg: 180 is out of range; expected a number above 0 and below 180 (degrees)"},
      {with(R"("fill": [{"box": {}, "jitter": 0.51}])"), "fill[0].jitter: 0.51 is out of range; expected a number from 0 to 0.5"},
      {with(R"("fill": [{"sphere": {"radius": 0}}])"), "fill[0].sphere.radius: 0 is out of range; expected a number above 0 (m)"},
  });
}

TEST(SceneErrors, ChecksRulesBetweenKeys) {
  const std::string order = "; expected min below max on every axis";
  expectRefusals({
      {with(R"("domain": {"min": [0, 2, 0]})"), "domain.max[1]: max is 1 and min is 2 along y" + order},
      {with(R"("fill": [{"box": {"min": [0, 0, 1], "max": [1, 1, 1]}}])"), "fill[0].box.max[2]: max is 1 and min is 1 along z" + order},
      {with(R"("solids": [{"box": {"min": [3, 0, 1], "max": [1, 1, 2]}}])"), "solids[0].box.max[0]: max is 1 and min is 3 along x" + order},
      {with(R"("fill": [{}])"), "fill[0]: expected exactly one of \"box\", \"sphere\", \"mesh\", \"particles\"; found none"},
      {with(R"("fill": [{"box": {}, "sphere": {}}])"),
       "fill[0]: expected exactly one of \"box\", \"sphere\", \"mesh\", \"particles\"; found \"box\", \"sphere\""},
      {with(R"("solids": [{"friction": 1}])"), "solids[0]: expected exactly one of \"box\", \"sphere\", \"mesh\"; found none"},
      {with(R"("probes": [{"name": "a"}])"),
       "probes[0]: expected exactly one of \"level\", \"front\", \"load\", \"pose\", \"pressure\", \"flow\"; found none"},
      {with(R"("probes": [{"front": "+x"}])"), "probes[0].name: required key is missing: name in the statistics; unique, not empty"},
      {with(R"("probes": [{"name": "", "front": "+x"}])"), "probes[0].name: found an empty name, expected a unique name"},
      {with(R"("probes": [{"name": "a", "front": "+x"}, {"name": "a", "front": "+y"}])"),
       "probes[1].name: \"a\" is also the name of probes[0]; expected unique names"},
      {with(R"("camera": {"eye": [1, 2, 3], "target": [1, 2, 3]})"),
       "camera.target: eye and target are the same point; expected two different points"},
      {with(R"("solids": [{"box": {}, "rotation": [0, 0, 0, 0]}])"),
       "solids[0].rotation: the quaternion has zero length; expected a non-zero quaternion, [0, 0, 0, 1] for no rotation"},
      {with(R"("gravity_changes": [{"at": 1}, {"at": 1}])"),
       "gravity_changes[1].at: found 1 s after 1 s in the previous entry, expected increasing times"},
      {with(R"("gravity_changes": [{"at": -1}])"), "gravity_changes[0].at: -1 is out of range; expected a number of at least 0 (s)"},
      {with(R"("solids": [{"sphere": {}, "motion": [{"at": 2}, {"at": 1}]}])"),
       "solids[0].motion[1].at: found 1 s after 2 s in the previous entry, expected increasing times"},
  });
  std::string solids;
  for (int i = 0; i < 4096; ++i) solids += R"({"sphere": {}},)";
  EXPECT_EQ(parseError(with("\"solids\": [" + solids.substr(0, solids.size() - 1) + "]")), "accepted");
  EXPECT_EQ(parseError(with("\"solids\": [" + solids + "{\"sphere\": {}}]")),
            "dam.json: solids: found 4,097 entries, expected at most 4,096");
}

}  // namespace
}  // namespace rill::test
