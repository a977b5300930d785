// Surface tension on the device: substeps against the reference, and momentum.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace surface_tension_test {

using SurfaceTensionTest = FluidTest;

constexpr double kTensionOne = 3e-4, kTensionTen = 2e-3, kTensionAgeing = 0.1;  // spacings

Trial withTension(double contactAngle = 90) {
  Trial t = trial();
  t.scene.fluid.surface_tension = 200;
  t.scene.fluid.contact_angle = contactAngle;
  return t;
}

TEST_F(SurfaceTensionTest, CloudMatchesReference) {
  Trial t = withTension();
  t.x = randomCloud(400, 7.4 * t.d(), 11);
  t.v = randomCloud(400, 1.0, 12, glm::dvec3(-0.5));
  expectEqual(t, 1, kTensionOne, kTensionOne, 0.001);  // particles with enough neighbors are taken for deep
}

TEST_F(SurfaceTensionTest, BlockMatchesReference) {
  Trial t = withTension();
  t.x = block({9, 9, 9}, t.d(), {}, 0.1);
  expectEqual(t, 1, kTensionOne, kTensionOne);
  expectEqual(t, 10, kTensionTen, kTensionTen, kTensionAgeing);
}

TEST_F(SurfaceTensionTest, BlockInACornerMatchesReference) {
  for (const double angle : {0.0, 60.0, 150.0}) {
    SCOPED_TRACE(angle);
    Trial t = withTension(angle);
    setWalls(t, {1, 1, 1});
    t.x = block({6, 7, 6}, t.d(), {}, 0.1);
    t.v = randomCloud(t.x.size(), 0.4, 5, glm::dvec3(-0.2));
    expectEqual(t, 1, kTensionOne, kTensionOne);
    expectEqual(t, 10, kTensionTen, kTensionTen, kTensionAgeing);
  }
}

TEST_F(SurfaceTensionTest, SolidsMatchReference) {
  for (const double ratio : {2.3, 1.8}) {
    SCOPED_TRACE(ratio);
    Trial t = withTension(30);
    t.scene.fluid.smoothing_ratio = ratio;
    t.scene.solids = {slab({0.1, 0, 0.1}, {0.9, 0.25, 0.9}), ball({0.5, 0.5, 0.5}, 0.12)};
    addOutsideSolids(t, block({7, 5, 7}, t.d(), {0.2, 0.26, 0.25}, 0.05));
    expectEqual(t, 1, kTensionOne, kTensionOne);
    expectEqual(t, 10, kTensionTen, kTensionTen, kTensionAgeing);
  }
}

TEST_F(SurfaceTensionTest, SeveralFluidsMatchReference) {
  Trial t = withTension();
  t.scene.fluids = {{.name = "water", .surface_tension = 100}, {.name = "oil", .density = 500}, {.name = "none", .surface_tension = 0}};
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(static_cast<uint8_t>(i * 7919 % 3));
  expectEqual(t, 1, kTensionOne, kTensionOne);
  expectEqual(t, 10, kTensionTen, kTensionTen, kTensionAgeing);
}

/// Particles of `count` fluids in any order, some of which have tension between them.
Trial withInterfaces(size_t count) {
  Trial t = withTension();
  t.scene.fluids = {{.name = "water", .surface_tension = 100}, {.name = "oil", .density = 500}, {.name = "none", .surface_tension = 0}};
  for (size_t k = 3; k < count; ++k) t.scene.fluids.push_back({.name = std::to_string(k), .density = 700 + 10 * double(k)});
  t.scene.interfaces = {{.between = {"oil", "water"}, .tension = 120}, {.between = {"none", "water"}, .tension = 60}};
  if (count > 7) t.scene.interfaces.push_back({.between = {"7", "6"}, .tension = 390});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(static_cast<uint8_t>(i * 7919 % count));
  return t;
}

TEST_F(SurfaceTensionTest, InterfacesMatchReference) {
  for (const size_t count : {3, 8}) {
    SCOPED_TRACE(count);
    const Trial t = withInterfaces(count);
    expectEqual(t, 1, kTensionOne, kTensionOne);
    expectEqual(t, 10, kTensionTen, kTensionTen, kTensionAgeing);
  }
}

// Inside fluid, where particles are deep.
TEST_F(SurfaceTensionTest, DropInsideFluidMatchesReference) {
  Trial t = withTension();
  t.scene.fluid.surface_tension = 0;
  t.scene.fluids = {{.name = "water"}, {.name = "oil", .density = 900}};
  t.scene.interfaces = {{.between = {"water", "oil"}, .tension = 200}};
  setWalls(t, {1, 1, 1});
  t.x = block({13, 13, 13}, t.d(), {}, 0.1);
  for (const glm::dvec3& x : t.x) t.fluids.push_back(glm::length(x - glm::dvec3(6.5 * t.d())) < 3.5 * t.d() ? 1 : 0);
  expectEqual(t, 1, kTensionOne, kTensionOne);
  expectEqual(t, 5, kTensionTen, kTensionTen, kTensionAgeing);
}

TEST_F(SurfaceTensionTest, RejectsListsOfAFluidWithoutIt) {
  Trial t = withTension();
  t.x = block({4, 4, 4}, t.d());
  t.scene.fluid.surface_tension = 0;
  auto run = start(t);
  run->substeps(2);
  FluidSnapshot saved = run->saved();
  ASSERT_TRUE(hasNeighbors(saved));
  t.scene.fluid.surface_tension = 200;
  saved.listCapacity = start(t)->saved().listCapacity;
  const Scene scene = t.timedScene();
  const ParticleSet particles = t.particles();
  const auto made = Fluid::create(rillDevice(), {.scene = &scene, .particles = &particles, .snapshot = &saved});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("far neighbors"), std::string::npos) << made.error().message;
}

TEST_F(SurfaceTensionTest, HandlesCoincidentParticlesOfTwoFluids) {
  Trial t = withInterfaces(3);
  t.scene.gravity[1] = 0;
  for (const uint8_t fluid : {uint8_t{0}, uint8_t{1}}) {
    t.x.push_back(t.x[100]);
    t.fluids.push_back(fluid);
  }
  forEachGather(t, 20, [&](Run& run) {
    EXPECT_TRUE(run.snapshot().finite());
    EXPECT_EQ(run.stats().nonFinite, 0u);
  });
}

TEST_F(SurfaceTensionTest, InterfacesConserveMomentum) {
  Trial t = withInterfaces(3);
  t.scene.gravity[1] = 0;
  t.x = block({6, 7, 6}, t.d());
  for (FluidInterface& pair : t.scene.interfaces) pair.tension /= 10;
  for (FluidMaterial& fluid : t.scene.fluids) fluid.density = 1000, fluid.surface_tension = fluid.surface_tension.value_or(200) / 10;
  forEachGather(t, 40, [&](Run& run) {
    const Snapshot s = run.snapshot();
    double moving = 0;
    for (const glm::dvec3& v : s.v) moving += glm::length(v);
    ASSERT_GT(moving / static_cast<double>(s.v.size()), 0.05);
    EXPECT_LT(glm::length(s.velocitySum()), 2e-4 * moving);
  });
}

// A lone particle, a pair, a line, and a sheet; all far apart.
TEST_F(SurfaceTensionTest, FewParticlesMatchReference) {
  Trial t = withTension();
  const double d = t.d();
  t.x = {{0, 0, 0}, {10 * d, 0, 0}, {10 * d, 0.9 * d, 0}};
  for (int k = 0; k < 6; ++k) t.x.push_back({30 * d, 0, k * d});
  for (const glm::dvec3& x : block({5, 1, 5}, d, {40 * d, 0, 0})) t.x.push_back(x);
  expectEqual(t, 1, kTensionOne, kTensionOne);
  expectEqual(t, 3, kTensionTen, kTensionTen);
}

// Their direction apart is that of their ids, and the next substeps separate them.
TEST_F(SurfaceTensionTest, HandlesCoincidentParticles) {
  Trial t = withTension();
  t.scene.gravity[1] = 0;
  t.x = block({3, 3, 3}, t.d());
  for (int copy = 0; copy < 2; ++copy) t.x.push_back(t.x[13]);
  forEachGather(t, 20, [&](Run& run) {
    const Snapshot s = run.snapshot();
    EXPECT_TRUE(s.finite());
    EXPECT_EQ(run.stats().nonFinite, 0u);
    for (const size_t copy : {27, 28}) EXPECT_GT(glm::length(s.x[copy] - s.x[13]), 0.1 * t.d());
  });
}

TEST_F(SurfaceTensionTest, LoneParticleFeelsNothing) {
  Trial t = withTension();
  t.scene.gravity[1] = 0;
  t.x = {{0, 0, 0}};
  t.v = {{0.25, 0, 0}};
  auto run = start(t);
  run->substeps(4);
  EXPECT_EQ(run->snapshot().v[0], glm::dvec3(0.25, 0, 0));
}

/// How many warnings of a scene start with `text`.
std::ptrdiff_t warningsWith(const Scene& scene, const std::string& text) {
  const auto setup = makeFluidSetup(scene, {.capacity = 100, .extent = {1, 1, 1}});
  EXPECT_TRUE(setup);
  return setup ? std::ranges::count_if(setup->warnings, [&](const std::string& warning) { return warning.starts_with(text); }) : -1;
}

TEST_F(SurfaceTensionTest, WarnsOfStepsAndAngles) {
  Scene scene = withTension(30).scene;
  scene.solver.time_step = 1e-3;
  const std::string step = "solver.time_step 0.016 s is more than ", angle = "fluid.contact_angle: has no effect: ";
  EXPECT_EQ(warningsWith(scene, "solver.time_step"), 0);
  EXPECT_EQ(warningsWith(scene, angle), 0);
  scene.solver.time_step = 0.016;
  EXPECT_EQ(warningsWith(scene, step + "fluid.surface_tension 200 N/m allows at this spacing: steps are at most 0.00"), 1);
  scene.fluids = {{.name = "water"}, {.name = "ether", .density = 500, .surface_tension = 150}};
  EXPECT_EQ(warningsWith(scene, step + "fluids.ether.surface_tension 150 N/m allows"), 1);
  scene = trial().scene;
  scene.fluid.contact_angle = 30;
  EXPECT_EQ(warningsWith(scene, angle + "the surface tension is 0, expected more (N/m)"), 1);
}

TEST_F(SurfaceTensionTest, RaisesTensionsThatInterfacesExceed) {
  Scene scene = trial().scene;
  scene.fluids = {{.name = "water", .surface_tension = 70}, {.name = "oil", .density = 500}};
  scene.interfaces = {{.between = {"oil", "water"}, .tension = 70}};
  EXPECT_EQ(warningsWith(scene, "fluids."), 0);
  scene.interfaces[0].tension = 90;
  EXPECT_EQ(resolvedFluids(scene)[0].surfaceTension, 80);
  EXPECT_EQ(resolvedFluids(scene)[1].surfaceTension, 10);
  const std::string why = " for the tension of its interfaces; it is simulated with that";
  EXPECT_EQ(warningsWith(scene, "fluids.water.surface_tension: found 70 N/m, expected at least 80" + why), 1);
  EXPECT_EQ(warningsWith(scene, "fluids.oil.surface_tension: found 0 N/m, expected at least 10" + why), 1);
  scene.fluids = {{.name = "a"}, {.name = "b"}, {.name = "c"}};
  for (const bool first : {true, false}) {
    scene.interfaces = {{.between = {"a", first ? "b" : "c"}, .tension = 100}, {.between = {"a", first ? "c" : "b"}, .tension = 100}};
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(resolvedFluids(scene)[k].surfaceTension, 50) << "in any order";
  }
}

// A light fluid feels what it covers in part of a heavy one's surface.
TEST_F(SurfaceTensionTest, WarningsNameTheFluidThatBoundsTheStep) {
  Scene scene = trial().scene;
  scene.solver.time_step = 1;
  for (const bool lightFirst : {true, false}) {
    scene.fluids = {{.name = "water", .surface_tension = 72}, {.name = "air", .density = 1, .surface_tension = 0}};
    if (lightFirst) std::swap(scene.fluids[0], scene.fluids[1]);
    scene.interfaces = {{.between = {"air", "water"}, .tension = 36}};
    EXPECT_EQ(warningsWith(scene, "solver.time_step 1 s is more than fluids.water.surface_tension 72 N/m allows at this spacing: "), 1);
  }
}

TEST_F(SurfaceTensionTest, MomentumIsConserved) {
  Trial t = withTension();
  t.scene.fluid.surface_tension = 20;  // so weak that no speed is held back (docs/notes/overlaps.md)
  t.scene.gravity[1] = 0;
  t.x = block({9, 5, 9}, t.d());
  forEachGather(t, 40, [&](Run& run) {
    const Snapshot s = run.snapshot();
    double moving = 0;
    for (const glm::dvec3& v : s.v) moving += glm::length(v);
    ASSERT_GT(moving / static_cast<double>(s.v.size()), 0.05) << "it contracts";
    EXPECT_LT(glm::length(s.velocitySum()), 2e-4 * moving);
  });
}

}  // namespace surface_tension_test
}  // namespace rill::test
