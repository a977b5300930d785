// checkScene() on scenes made in code: invalid values are rejected with a message that names the key.
#include <functional>
#include <limits>

#include "support.hpp"
#include "tank.hpp"

namespace rill::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

/// The error message of a scene, or "accepted".
std::string errorOf(const Scene& scene) {
  const auto checked = checkScene(scene);
  if (checked) return "accepted";
  EXPECT_EQ(checked.error().kind, ErrorKind::BadInput);
  return checked.error().message;
}

struct Change {
  std::function<void(Scene&)> make;
  std::string message;
};

TEST(CheckScene, AcceptsValidScenes) {
  EXPECT_EQ(errorOf(tank()), "accepted");
  Scene least;
  least.fluid.spacing = 1;
  EXPECT_EQ(errorOf(least), "accepted");
  least.fluid.spacing = 0;
  least.fluid.particles = 100;
  EXPECT_EQ(errorOf(least), "accepted");
  Scene turned = tank();
  turned.solids[0].rotation[3] = 0.9999;  // rounding of float quaternions
  EXPECT_EQ(errorOf(turned), "accepted");
}

TEST(CheckScene, AcceptsSpacingComputedFromParticles) {
  Scene scene = tank();
  scene.fluid.spacing = 0;
  scene.fluid.particles = 500;
  const auto first = makeParticles(scene);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_GT(first->spacing, 0);
  EXPECT_EQ(scene.fluid.spacing, 0) << "the scene is left as it was";
  scene.fluid.spacing = first->spacing;
  EXPECT_EQ(errorOf(scene), "accepted");
  const auto second = makeParticles(scene);
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(first->positions.size(), second->positions.size());
}

TEST(CheckScene, RejectsInvalidValuesNamingKeyAndExpectation) {
  const std::vector<Change> changes = {
      {[](Scene& s) { s.fluid.viscosity = -1; }, "fluid.viscosity: -1 is out of range; expected a number of at least 0 (Pa s)"},
      {[](Scene& s) { s.fluid.viscosity = kNan; }, "fluid.viscosity: nan is not finite; expected a number of at least 0 (Pa s)"},
      {[](Scene& s) { s.fluid.density = 0; }, "fluid.density: 0 is out of range; expected a number above 0 (kg/m^3)"},
      {[](Scene& s) { s.fluid.smoothing_ratio = 40; }, "fluid.smoothing_ratio: 40 is out of range; expected a number from 1.2 to 4"},
      {[](Scene& s) { s.fluid.spacing = -0.1; }, "fluid.spacing: -0.1 is out of range; expected a number above 0 (m)"},
      {[](Scene& s) { s.fluid.spacing = kInf; }, "fluid.spacing: inf is not finite; expected a number above 0 (m)"},
      {[](Scene& s) { s.fluid.spacing = 0; }, "fluid: expected exactly one of \"spacing\", \"particles\"; found none"},
      {[](Scene& s) { s.fluid.particles = uint64_t{1} << 40; },
       "fluid.particles: 1099511627776 is out of range; expected a whole number from 1 to 4294967295"},
      {[](Scene& s) { s.fluid.spacing = 1e-20; },
       "fluid.spacing: the mass of a particle, density x spacing^3, is 1e-57 kg; expected a mass that fits a 32-bit float"},
      {[](Scene& s) { s.gravity[1] = kNan; }, "gravity[1]: nan is not finite; expected a number (m/s^2)"},
      {[](Scene& s) { s.gravity[2] = -1e300; }, "gravity[2]: -1e+300 is out of range of a 32-bit float; expected a number (m/s^2)"},
      {[](Scene& s) { s.duration = -1; }, "duration: -1 is out of range; expected a number of at least 0 (s)"},
      {[](Scene& s) { s.solver.iterations = 0; }, "solver.iterations: 0 is out of range; expected a whole number from 1 to 1000"},
      {[](Scene& s) { s.solver.iterations = 4'000'000'000; },
       "solver.iterations: 4000000000 is out of range; expected a whole number from 1 to 1000"},
      {[](Scene& s) { s.solver.max_substeps = 1'000'000'000; },
       "solver.max_substeps: 1000000000 is out of range; expected a whole number from 1 to 256"},
      {[](Scene& s) { s.solver.time_step = 0.0; }, "solver.time_step: 0 is out of range; expected a number above 0 (s)"},
      {[](Scene& s) { s.solver.relaxation = 3.0; }, "solver.relaxation: 3 is out of range; expected a number above 0 and at most 2"},
      {[](Scene& s) { s.solver.kernel = KernelChoice(7); },
       "solver.kernel: invalid enum value 7; expected the value of \"wendland\", \"poly6_spiky\""},
      {[](Scene& s) { s.solver.neighbors = NeighborChoice(2); },
       "solver.neighbors: invalid enum value 2; expected the value of \"list\", \"grid\""},
      {[](Scene& s) { std::swap(s.domain->min[1], s.domain->max[1]); },
       "domain.max[1]: max is 0 and min is 1 along y; expected min below max on every axis"},
      {[](Scene& s) { s.domain->max[0] = kNan; }, "domain.max[0]: nan is not finite; expected a number (m)"},
      {[](Scene& s) { s.domain->open = 0x40; },
       "domain.open: invalid bit mask 64; expected only the bits of \"-x\", \"+x\", \"-y\", \"+y\", \"-z\", \"+z\""},
      {[](Scene& s) {
         s.fill[0].shape = BoxShape{{0, 0, 0}, {1, 1, 0}};
       },
       "fill[0].box.max[2]: max is 0 and min is 0 along z; expected min below max on every axis"},
      {[](Scene& s) { s.fill[1].shape = ParticleFile{}; }, "fill[1].particles.file: found \"\", expected a file name"},
      {[](Scene& s) { s.fill[0].jitter = 7; }, "fill[0].jitter: 7 is out of range; expected a number from 0 to 0.5"},
      {[](Scene& s) { s.fill[0].velocity[2] = kInf; }, "fill[0].velocity[2]: inf is not finite; expected a number (m/s)"},
      {[](Scene& s) { std::get<SphereShape>(s.fill[1].shape).radius = -2; },
       "fill[1].sphere.radius: -2 is out of range; expected a number above 0 (m)"},
      {[](Scene& s) { std::get<BoxShape>(s.solids[0].shape).min[1] = kNan; },
       "solids[0].box.min[1]: nan is not finite; expected a number (m)"},
      {[](Scene& s) {
         s.solids[1].shape = SphereShape{{0, 0, 0}, 0};
       },
       "solids[1].sphere.radius: 0 is out of range; expected a number above 0 (m)"},
      {[](Scene& s) { s.solids[0].rotation[3] = 0; },
       "solids[0].rotation: the quaternion has zero length; expected a non-zero quaternion, [0, 0, 0, 1] for no rotation"},
      {[](Scene& s) { s.solids[0].rotation[0] = 1; }, "solids[0].rotation: the quaternion's length is 1.414; expected 1"},
      {[](Scene& s) { s.solids[1].motion[1].rotate[3] = 0; },
       "solids[1].motion[1].rotate: the quaternion has zero length; expected a non-zero quaternion, [0, 0, 0, 1] for no rotation"},
      {[](Scene& s) { s.solids[1].motion[0].rotate[1] = 1; }, "solids[1].motion[0].rotate: the quaternion's length is 1.414; expected 1"},
      {[](Scene& s) { s.solids[0].restitution = 1.5; }, "solids[0].restitution: 1.5 is out of range; expected a number from 0 to 1"},
      {[](Scene& s) { s.solids[0].driven = -1; }, "solids[0].driven: -1 is out of range; expected a speed of at least 0 (m/s)"},
      {[](Scene& s) { s.solids[0].driven = 1e300; }, "solids[0].driven: 1e+300 is out of range; expected a speed of at least 0 (m/s)"},
      {[](Scene& s) { s.solids[1].driven = 1; },
       "solids[1].driven: found 1 for a solid with keyframes; expected 0, or a solid without motion"},
      {[](Scene& s) { std::swap(s.solids[1].motion[0].at, s.solids[1].motion[1].at); },
       "solids[1].motion[1].at: found 0.5 s after 1 s in the previous entry, expected increasing times"},
      {[](Scene& s) { s.solids.resize(5000, s.solids[0]); }, "solids: found 5,000 entries, expected at most 4,096"},
      {[](Scene& s) { s.gravity_changes[1].at = 1; },
       "gravity_changes[1].at: found 1 s after 1 s in the previous entry, expected increasing times"},
      {[](Scene& s) { s.gravity_changes[0].value[0] = kNan; }, "gravity_changes[0].value[0]: nan is not finite; expected a number (m/s^2)"},
      {[](Scene& s) { s.probes[0].name.clear(); }, "probes[0].name: found an empty name, expected a unique name"},
      {[](Scene& s) { s.probes[1].name = "gauge"; }, "probes[1].name: \"gauge\" is also the name of probes[0]; expected unique names"},
      {[](Scene& s) { s.probes[1].front = Axis(6); },
       "probes[1].front: invalid enum value 6; expected the value of \"+x\", \"-x\", \"+y\", \"-y\", \"+z\", \"-z\""},
      {[](Scene& s) { s.probes[0].level->second = kNan; }, "probes[0].level[1]: nan is not finite; expected a number (m)"},
      {[](Scene& s) { s.probes.push_back({.name = "l", .load = "crate"}); },
       "probes[2].load: no solid is named \"crate\"; expected the name of a solid, but no solid has one"},
      {[](Scene& s) {
         s.solids[0].name = "crate";
         s.probes.push_back({.name = "p", .pose = "crat"});
       },
       "probes[2].pose: no solid is named \"crat\"; expected one of \"crate\"; did you mean \"crate\"?"},
      {[](Scene& s) { s.probes[0].load = "crate"; },
       "probes[0]: expected exactly one of \"level\", \"front\", \"load\", \"pose\", \"pressure\", \"flow\"; found \"level\", \"load\""},
      {[](Scene& s) { s.solids[0].body = Body{}; }, "solids[0].body: expected exactly one of \"density\", \"mass\"; found none"},
      {[](Scene& s) { s.solids[0].body = Body{.density = 500, .mass = 3}; },
       "solids[0].body: expected exactly one of \"density\", \"mass\"; found \"density\", \"mass\""},
      {[](Scene& s) { s.solids[0].body = Body{.mass = kInf}; }, "solids[0].body.mass: inf is not finite; expected a number above 0 (kg)"},
      {[](Scene& s) {
         s.solids[0].motion.clear();
         s.solids[0].driven = 1;
         s.solids[0].body = Body{.density = 500};
       },
       "solids[0].body: found a body that the host drives; expected \"body\" or \"driven\", not both"},
      {[](Scene& s) { s.emitters[0].flow = 0; }, "emitters[0]: expected exactly one of \"flow\", \"speed\"; found none"},
      {[](Scene& s) { s.emitters[0].speed = 1; }, "emitters[0]: expected exactly one of \"flow\", \"speed\"; found \"flow\", \"speed\""},
      {[](Scene& s) { s.emitters[0].flow = kNan; }, "emitters[0].flow: nan is not finite; expected a number above 0 (m^3/s)"},
      {[](Scene& s) { s.emitters[1].speed = kInf; }, "emitters[1].speed: inf is not finite; expected a number above 0 (m/s)"},
      {[](Scene& s) { std::get<DiscMouth>(s.emitters[0].mouth).normal = {}; },
       "emitters[0].disc.normal: found a vector of zero length, expected a direction"},
      {[](Scene& s) { std::get<RectMouth>(s.emitters[1].mouth).size.second = -1; },
       "emitters[1].rect.size[1]: -1 is out of range; expected a number above 0 (m)"},
      {[](Scene& s) {
         std::get<RectMouth>(s.emitters[1].mouth).up = {3, 0, 0};
       },
       "emitters[1].rect.up: found [3, 0, 0], which is parallel to the normal; expected another direction"},
      {[](Scene& s) { s.emitters[0].until = 0.5; }, "emitters[0].until: found 0.5 s, expected a time later than from, 0.5 s"},
      {[](Scene& s) { s.emitters.resize(300, s.emitters[1]); }, "emitters: found 300 entries, expected at most 256"},
      {[](Scene& s) { s.drains[0].from = kNan; }, "drains[0].from: nan is not finite; expected a number of at least 0 (s)"},
      {[](Scene& s) { s.drains[0].until = kInf; }, "drains[0].until: inf is not finite; expected a number above 0 (s)"},
      {[](Scene& s) {
         s.drains[0].shape = SphereShape{{0, 0, 0}, 0};
       },
       "drains[0].sphere.radius: 0 is out of range; expected a number above 0 (m)"},
      {[](Scene& s) { s.drains[0].name = "tap"; },
       "drains[0].name: \"tap\" is also the name of emitters[0]; expected unique names among emitters and drains"},
      {[](Scene& s) { s.probes.push_back({.name = "rate", .flow = "plg"}); },
       "probes[2].flow: no emitter or drain is named \"plg\"; expected one of \"tap\", \"plug\"; did you mean \"plug\"?"},
      {[](Scene& s) { s.domain->open_removes = true; },
       "domain.open_removes: found true, but no side is open; expected sides in \"open\", or false"},
      {[](Scene& s) { s.fluid.capacity = kMaxParticles + 1; },
       "fluid.capacity: 67108865 is out of range; expected a whole number from 0 to 67108864"},
      {[](Scene& s) { s.camera->eye[2] = 0; }, "camera.target: eye and target are the same point; expected two different points"},
      {[](Scene& s) { s.look.sky = "dya"; },
       "look.sky: found the string \"dya\", expected one of \"studio\", \"day\", \"sunset\"; did you mean \"day\"?"},
      {[](Scene& s) { s.look.preset = "watr"; },
       "look.preset: found the string \"watr\", expected one of \"water\", \"milk\", \"ink\", \"clay\", \"pool\", \"sea\", \"river\", "
       "\"honey\", \"lava\", \"diluted_milk\"; did you mean \"water\"?"},
  };
  for (const Change& change : changes) {
    Scene scene = tank();
    change.make(scene);
    EXPECT_EQ(errorOf(scene), change.message);
    const auto made = makeParticles(scene);
    ASSERT_FALSE(made) << change.message;
    EXPECT_EQ(made.error().message, change.message);
  }
  Scene named = tank();
  named.name = "tank";
  named.seed = std::numeric_limits<uint64_t>::max();
  EXPECT_EQ(errorOf(named), "accepted");
  named.solver.cfl = 11;
  EXPECT_EQ(errorOf(named), "tank: solver.cfl: 11 is out of range; expected a number above 0 and at most 10");
}

// Files and scenes made in code are checked by the same rules.
TEST(CheckScene, AcceptsEveryShippedScene) {
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes")) {
    if (entry.path().extension() != ".json" || entry.path().filename() == "scene.schema.json") continue;
    const auto read = loadScene(entry.path());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(errorOf(*read), "accepted") << entry.path();
  }
}

}  // namespace
}  // namespace rill::test
