#include <cmath>

#include "support.hpp"

namespace rill::test {
namespace {

TEST(SceneReader, UsesStructDefaults) {
  const Scene s = scene(withFluid("\"spacing\": 0.1"));
  EXPECT_EQ(s.name, "dam");
  EXPECT_TRUE(s.file.empty());
  EXPECT_EQ(s.fluid.spacing, 0.1);
  EXPECT_EQ(s.fluid.density, 1000);
  EXPECT_EQ(s.gravity[1], -9.81);
  EXPECT_EQ(s.seed, 1U);
  EXPECT_FALSE(s.domain || s.camera || s.solver.time_step || s.solver.relaxation || s.solver.warm_start);
  EXPECT_TRUE(s.fill.empty() && s.solids.empty() && s.probes.empty() && s.gravity_changes.empty());
}

TEST(SceneReader, ReadsEveryKey) {
  const Scene s = scene(R"({
    "rill": "0.1.0", "title": "T", "about": "A", "extras": {"x": 1}, /* a
    comment */ "duration": 4, "seed": 18446744073709551615, "gravity": [1, 2, 3],
    "gravity_changes": [{"at": 0, "value": [1, 0, 0]}, {"at": 2.5, "value": [0, 1, 0]}],
    "domain": {"min": [-1, -2, -3], "max": [1, 2, 3], "open": ["+y", "-x"]},
    "fluid": {"particles": 1e3, "density": 800, "smoothing_ratio": 2.5, "viscosity": 0.1, "vorticity": 0.2, "tensile": 0.3, "tensile_radius": 0.25, "tensile_power": 5},
    "solver": {"time_step": 0.01, "cfl": 0.5, "max_substeps": 32, "iterations": 4, "tolerance": 0, "relaxation": 0.5, "regularization": 0.1,
               "warm_start": 0.02, "kernel": "poly6_spiky", "neighbors": "grid"},
    "fill": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "velocity": [1, 2, 3], "jitter": 0.25}, {"sphere": {"center": [1, 2, 3], "radius": 4}}],
    "solids": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "rotation": [0, 2, 0, 0], "friction": 0.5, "restitution": 1,
                "motion": [{"at": 0}, {"at": 1, "translate": [1, 0, 0]}]}, {"sphere": {"radius": 2}}],
    "probes": [{"name": "H1", "level": [0.3, 0.075]}, {"name": "f", "front": "-z"}],
    "camera": {"eye": [1, 1, 1], "target": [0, 0, 0], "fov_y_deg": 50},
    "look": {"preset": "water", "surface": "planes"}  // the end
  })");
  EXPECT_EQ(s.title, "T");
  EXPECT_EQ(s.seed, 18446744073709551615ULL);
  EXPECT_EQ(s.gravity_changes.size(), 2U);
  EXPECT_EQ(s.gravity_changes[1].at, 2.5);
  ASSERT_TRUE(s.domain);
  EXPECT_EQ(s.domain->open, 0b1001);
  EXPECT_EQ(s.fluid.particles, 1000U);
  EXPECT_EQ(s.fluid.spacing, 0);
  EXPECT_EQ(s.fluid.tensile_power, 5);
  EXPECT_EQ(s.solver.time_step, 0.01);
  EXPECT_EQ(s.solver.iterations, 4U);
  EXPECT_EQ(s.solver.warm_start, 0.02);
  EXPECT_EQ(s.solver.kernel, KernelChoice::Poly6Spiky);
  EXPECT_EQ(s.solver.neighbors, NeighborChoice::Grid);
  EXPECT_EQ(s.fill[0].velocity[2], 3);
  EXPECT_EQ(std::get<SphereShape>(s.fill[1].shape).radius, 4);
  EXPECT_EQ(s.solids[0].rotation[1], 1);
  EXPECT_EQ(s.solids[0].motion[1].translate[0], 1);
  EXPECT_EQ(s.probes[0].level->second, 0.075);
  EXPECT_EQ(s.probes[1].front, Axis::MinusZ);
  EXPECT_EQ(s.camera->fov_y_deg, 50);
  EXPECT_EQ(s.look.surface, "planes");
}

TEST(SceneReader, NormalizesQuaternions) {
  const Scene s = scene(with(R"("solids": [{"box": {}, "rotation": [1e30, 0, 0, 1e30]}, {"box": {}, "rotation": [1e-30, 0, 0, 1e-30]}])"));
  for (const Solid& solid : s.solids) {
    EXPECT_NEAR(solid.rotation[0], std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(solid.rotation[3], std::sqrt(0.5), 1e-12);
  }
}

TEST(SceneReader, NormalizesRotationsOfKeyframes) {
  const Scene s = scene(
      R"({"rill": "0.2", "fluid": {"spacing": 0.1}, "solids": [{"sphere": {}, "motion": [{"at": 0}, {"at": 1, "rotate": [0, 3, 0, 4]}]}]})");
  EXPECT_EQ(s.solids[0].motion[0].rotate[3], 1);
  EXPECT_NEAR(s.solids[0].motion[1].rotate[1], 0.6, 1e-15);
  EXPECT_NEAR(s.solids[0].motion[1].rotate[3], 0.8, 1e-15);
}

TEST(SceneReader, TreatsAutoAsDefault) {
  const Scene s = scene(with(R"("solver": {"time_step": "auto", "relaxation": "auto", "regularization": "auto", "warm_start": "auto"})"));
  EXPECT_FALSE(s.solver.time_step || s.solver.relaxation || s.solver.regularization || s.solver.warm_start);
}

TEST(Overrides, SetKeysBeforeValidation) {
  const std::string base = with(R"("fill": [{"box": {}}])");
  const Scene s = scene(base, {{"fluid.viscosity", "0.1"},
                               {"fill[0].jitter", "0.1"},
                               {"gravity", "[0,-1,0]"},
                               {"look.surface", "planes"},
                               {"title", "2024"},
                               {"solver.kernel", "\"poly6_spiky\""},
                               {"solver.time_step", "0.002"},
                               {"domain.open", "[\"+y\"]"},
                               {"fluid.density", "900"},
                               {"fluid.density", "950"},
                               {"extras.note.deep", "anything at all"}});
  EXPECT_EQ(s.fluid.viscosity, 0.1);
  EXPECT_EQ(s.fill[0].jitter, 0.1);
  EXPECT_EQ(s.gravity[1], -1);
  EXPECT_EQ(s.look.surface, "planes");
  EXPECT_EQ(s.title, "2024");
  EXPECT_EQ(s.solver.kernel, KernelChoice::Poly6Spiky);
  EXPECT_EQ(s.solver.time_step, 0.002);
  EXPECT_EQ(s.domain->open, 0b1000);
  EXPECT_EQ(s.fluid.density, 950);
}

TEST(Overrides, CanRepairInvalidScene) {
  EXPECT_EQ(parseError(withFluid("\"spacing\": -1"), {{"fluid.spacing", "0.1"}}), "accepted");
  EXPECT_EQ(parseError("{}", {{"rill", "0.1"}, {"fluid.spacing", "0.1"}}), "accepted");
}

TEST(Overrides, SpacingAndParticlesReplaceEachOther) {
  const Scene by_count = scene(withFluid("\"spacing\": 0.1"), {{"fluid.particles", "500"}});
  EXPECT_EQ(by_count.fluid.particles, 500U);
  EXPECT_EQ(by_count.fluid.spacing, 0);
  const Scene by_spacing = scene(withFluid("\"particles\": 10"), {{"fluid.spacing", "0.2"}});
  EXPECT_EQ(by_spacing.fluid.particles, 0U);
  EXPECT_EQ(by_spacing.fluid.spacing, 0.2);
}

TEST(Overrides, ChangeAndAddListEntries) {
  const Scene s =
      scene(with(R"("fill": [{"box": {}}])"), {{"fill[1]", R"({"sphere": {"radius": 2}})"}, {"gravity", "[1,2,3]"}, {"gravity[2]", "7"}});
  ASSERT_EQ(s.fill.size(), 2U);
  EXPECT_EQ(std::get<SphereShape>(s.fill[1].shape).radius, 2);
  EXPECT_EQ(s.gravity[2], 7);
}

TEST(Overrides, ErrorsNameTheOverride) {
  const std::string base = with(R"("fill": [{"box": {}}])");
  const auto message = [&](const std::string& key, const std::string& value) { return parseError(base, {{key, value}}); };
  EXPECT_EQ(message("fluid.viscosty", "1"), "--set fluid.viscosty: unknown key; did you mean \"viscosity\"?");
  EXPECT_EQ(message("fluidd.viscosity", "1"), "--set fluidd.viscosity: fluidd: unknown key; did you mean \"fluid\"?");
  EXPECT_EQ(message("viscosity", "1"), "--set viscosity: unknown key; did you mean \"fluid.viscosity\"?");
  EXPECT_EQ(message("fluid.viscosity", "thick"),
            "--set fluid.viscosity: found the string \"thick\", expected a number of at least 0 (Pa s)");
  EXPECT_EQ(message("fluid.viscosity", ""), "--set fluid.viscosity: found the string \"\", expected a number of at least 0 (Pa s)");
  EXPECT_EQ(message("fluid.viscosity", "nan"),
            "--set fluid.viscosity: found the string \"nan\", which is not finite; expected a number of at least 0 (Pa s)");
  EXPECT_EQ(message("fluid.viscosity", "-1"), "--set fluid.viscosity: -1 is out of range; expected a number of at least 0 (Pa s)");
  EXPECT_NE(message("fluid.viscosity", "1e999").find("--set fluid.viscosity:1:1: the number is out of range; expected"), std::string::npos);
  EXPECT_EQ(message("fluid.viscosity.x", "1"),
            "--set fluid.viscosity.x: fluid.viscosity: found an object, expected a number of at least 0 (Pa s)");
  EXPECT_EQ(message("rill", "999.5").rfind("--set rill: the scene needs Rill 999.5 or later; this is Rill ", 0), 0U);
  EXPECT_EQ(message("fill[0]", R"({"box": {"mn": 1}})"), "--set fill[0]: fill[0].box.mn: unknown key; did you mean \"min\"?");
  EXPECT_EQ(message("fill[0].sphere", "{}"),
            "--set fill[0].sphere: expected exactly one of \"box\", \"sphere\", \"mesh\", \"particles\"; found \"box\", \"sphere\"");
  EXPECT_EQ(message("fill[0].box.max", "[0,1,1]"),
            "--set fill[0].box.max: fill[0].box.max[0]: max is 0 and min is 0 along x; expected min below max on every axis");
  EXPECT_EQ(message("fill[5].jitter", "0"),
            "--set fill[5].jitter: fill has 1 entry in the scene; expected an index of at most 1 (one more adds an entry)");
  EXPECT_EQ(message("fluid[0]", "0"), "--set fluid[0]: fluid is not a list; expected a key without an index");
  EXPECT_EQ(message("fluid.spacing.x", "0"), "--set fluid.spacing.x: fluid.spacing is not an object; expected a key path of the scene");
  const std::string path = "; expected a key path such as fluid.viscosity, fill[0].jitter or fluids.oil.density";
  EXPECT_EQ(message("fluid..x", "0"), "--set fluid..x: a key is empty" + path);
  EXPECT_EQ(message("fluid.", "0"), "--set fluid.: a key is empty" + path);
  EXPECT_EQ(message("fill[", "0"), "--set fill[: \"\" is not an index in brackets" + path);
  EXPECT_EQ(message("fill[x]", "0"), "--set fill[x]: \"x\" is not an index in brackets" + path);
  EXPECT_EQ(message("fill[99999999999999999999]", "0"),
            "--set fill[99999999999999999999]: \"99999999999999999999\" is not an index in brackets" + path);
  EXPECT_EQ(message("fill[0]jitter", "0"), "--set fill[0]jitter: unexpected \"jitter\" after an index" + path);
  EXPECT_EQ(message("gravity", "[0,-1,0").rfind("--set gravity:1:", 0), 0U) << message("gravity", "[0,-1,0");
}

TEST(Overrides, ErrorsOfTheFileNameTheFile) {
  EXPECT_EQ(parseError(withFluid("\"spacing\": -1"), {{"fluid.viscosity", "1"}}),
            "dam.json: fluid.spacing: -1 is out of range; expected a number above 0 (m)");
}

/// Images and particle files with the same names in the folder of the scene and in its parent.
TEST(Overrides, ResolveRelativePathsAgainstCurrentDirectory) {
  const Folder above;
  std::filesystem::create_directory(above.path / "scenes");
  for (const char* name : {"sky.hdr", "scenes/sky.hdr", "water.ply", "scenes/water.ply"}) above.write(name, "x");
  above.write("scenes/beside.hdr", "x");
  const auto file =
      above.write("scenes/dam.json", with(R"("fill": [{"particles": {"file": "water.ply"}}], "look": {"environment": "sky.hdr"})"));
  const std::string sky = std::filesystem::relative(above.path / "sky.hdr").string(),
                    water = std::filesystem::relative(above.path / "water.ply").string();
  const auto read = [&](std::vector<Override> overrides, const std::string& environment, const std::string& particles) {
    const auto scene = loadScene(file, overrides);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(std::filesystem::equivalent(scene->look.environment, above.path / environment)) << scene->look.environment;
    EXPECT_TRUE(std::filesystem::equivalent(std::get<ParticleFile>(scene->fill[0].shape).file, above.path / particles))
        << std::get<ParticleFile>(scene->fill[0].shape).file;
    EXPECT_TRUE(scene->look.environment.is_absolute() && std::get<ParticleFile>(scene->fill[0].shape).file.is_absolute());
  };
  read({}, "scenes/sky.hdr", "scenes/water.ply");
  read({{"look.preset", "milk"}, {"fill[0].jitter", "0.1"}}, "scenes/sky.hdr", "scenes/water.ply");
  read({{"look.environment", sky}}, "sky.hdr", "scenes/water.ply");
  read({{"fill[0].particles.file", water}}, "scenes/sky.hdr", "water.ply");
  read({{"fill[0]", R"({"particles": {"file": ")" + water + "\"}}"}, {"look", R"({"environment": ")" + sky + "\"}"}}, "sky.hdr",
       "water.ply");
  read({{"look.environment", (above.path / "sky.hdr").string()}}, "sky.hdr", "scenes/water.ply");

  const auto missing = loadScene(file, std::vector<Override>{{"look.environment", "beside.hdr"}});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "--set look.environment: \"beside.hdr\": no such file (looked for " +
                                         (std::filesystem::current_path() / "beside.hdr").string() + ")");
}

TEST(Overrides, ParseKeyEqualsValue) {
  const auto good = parseOverride("fluid.viscosity=0.1");
  ASSERT_TRUE(good);
  EXPECT_EQ(good->key, "fluid.viscosity");
  EXPECT_EQ(good->value, "0.1");
  EXPECT_EQ(parseOverride("title=a=b")->value, "a=b");
  EXPECT_EQ(parseOverride("title=")->value, "");
  EXPECT_EQ(parseOverride("viscosity").error().message, "--set viscosity: no '='; expected KEY=VALUE, as in fluid.viscosity=0.1");
  EXPECT_EQ(parseOverride("=3").error().message, "--set =3: no key before '='; expected KEY=VALUE, as in fluid.viscosity=0.1");
  EXPECT_EQ(parseOverride("").error().kind, ErrorKind::BadInput);
}

/// Arbitrary bytes are read, or rejected with a message that names the file.
TEST(SceneReader, HandlesTruncatedAndFlippedScenes) {
  std::ifstream in(std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes/box-and-sphere.json");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  ASSERT_GT(text.size(), 500U);
  const auto check = [](const std::string& bytes) {
    const auto result = parse(bytes);
    if (!result) {
      EXPECT_EQ(result.error().message.rfind("dam.json:", 0), 0U) << result.error().message;
      EXPECT_EQ(result.error().kind, ErrorKind::BadInput);
      return;
    }
    Scene s = *result;
    (void)makeParticles(s, 100'000);  // may fail, must not crash
  };
  for (size_t length = 0; length < text.size(); ++length) check(text.substr(0, length));
  uint64_t random = 12345;
  for (int round = 0; round < 4000; ++round) {
    std::string flipped = text;
    for (int flips = 0; flips <= round % 3; ++flips) {
      random = random * 6364136223846793005ULL + 1442695040888963407ULL;
      flipped[(random >> 33) % flipped.size()] ^= static_cast<char>(1 << (random >> 60 & 7));
    }
    check(flipped);
  }
}

}  // namespace
}  // namespace rill::test
