// What is asked for beyond what is stable: bounded so that no energy comes of it, or refused.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"
#include "fluid/settings.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace bounds_test {

// A column that breaks, in steps that the solver chooses.
Trial dam() {
  Trial t = trial();
  setWalls(t, {1, 1, 0.375});
  t.x = block({6, 10, 6}, t.d());
  t.step = 1.0 / 60;
  t.scene.solver.cfl = 0.25;
  t.scene.solver.tolerance = 0.001;
  t.scene.fluid.tensile = FluidSettings{}.tensile;
  t.scene.solver.relaxation = {};
  t.scene.solver.warm_start = {};
  return t;
}

class BoundsTest : public FluidTest {
 protected:
  /// The most energy of `frames` frames over the start's, potential energy from the floor.
  double maxEnergy(const Trial& t, int frames) {
    auto run = start(t);
    const auto energy = [&] {
      const FluidStats s = run->stats();
      return s.kinetic_J + s.potential_J;
    };
    const double first = energy();
    double most = 0;
    for (int frame = 0; frame < frames; ++frame) {
      run->advance(1.0 / 60);
      most = std::max(most, energy());
    }
    return most / first;
  }
};

FluidSetup setupOf(const Scene& scene) {
  auto setup = makeFluidSetup(scene, {.capacity = 360, .extent = {0.3, 0.6, 0.3}});
  if (!setup) throw std::runtime_error(setup.error().message);
  return *std::move(setup);
}

bool warned(const FluidSetup& setup, std::string_view start) {
  return std::ranges::any_of(setup.warnings, [&](const std::string& text) { return text.starts_with(start); });
}

TEST_F(BoundsTest, SoftFluidGainsNoEnergy) {
  Trial t = dam();
  t.scene.solver.regularization = 300;
  t.scene.solver.warm_start = 0.2;
  EXPECT_LT(maxEnergy(t, 40), 1.02);
}

// A correction that is softer by a factor takes steps that are shorter by its root: the column is compressed by as much.
TEST_F(BoundsTest, SoftFluidTakesShorterSteps) {
  Scene scene = dam().scene;
  scene.solver.warm_start = 0.1;
  const FluidSetup usual = setupOf(scene);
  scene.solver.regularization = 1;
  const FluidSetup soft = setupOf(scene);
  EXPECT_NEAR(soft.longestStep / usual.longestStep, std::sqrt(1.02 / 2), 1e-3);
  EXPECT_NEAR(soft.firstStep / usual.firstStep, std::sqrt(1.02 / 2), 1e-3);
  EXPECT_NEAR(soft.params.warmGainInMotion, 0.1 * 1.02 / 2, 1e-6);
  EXPECT_EQ(usual.params.warmGainInMotion, 0.1f);
  EXPECT_TRUE(
      warned(soft, "solver.warm_start: expected at most 0.051, beyond which this kernel and regularization gain energy, found 0.1; "));
  EXPECT_FALSE(warned(usual, "solver.warm_start"));
}

TEST_F(BoundsTest, PolySpikyGainsNoEnergy) {
  Trial t = dam();
  t.scene.solver.kernel = KernelChoice::Poly6Spiky;
  t.scene.solver.regularization = 50;
  t.scene.solver.warm_start = 0.5;
  const FluidSetup setup = setupOf(t.scene);
  EXPECT_TRUE(warned(setup, "solver.regularization: expected at most 1, beyond which this kernel gains energy, found 50; 1 is used"));
  EXPECT_TRUE(warned(setup, "solver.warm_start: expected at most "));
  EXPECT_LT(maxEnergy(t, 40), 1.02);
}

// The corrections of all iterations are bounded in what they add to speeds, not the last one's alone.
TEST_F(BoundsTest, IterationsWithoutTensileGainNoEnergy) {
  Trial t = dam();
  t.scene.gravity = {2.1, -9.3, 4.5};
  t.scene.solver.iterations = 8;
  t.scene.fluid.tensile = 0;
  setWalls(t, {0.87, 0.75, 0.3});
  t.x = block({5, 4, 3}, t.d());
  EXPECT_LT(maxEnergy(t, 40), 1.02);
}

TEST_F(BoundsTest, StrongTensileGainsNoEnergy) {
  Trial t = dam();
  t.scene.fluid.tensile = 1;
  for (const double radius : {0.25, 0.46}) {  // half a spacing, and nearly one
    t.scene.fluid.tensile_radius = radius;
    EXPECT_LT(maxEnergy(t, 40), 1.02) << radius;
  }
  t.scene.solver.kernel = KernelChoice::Poly6Spiky;
  t.scene.fluid.tensile_radius = 0.25;
  EXPECT_LT(maxEnergy(t, 40), 1.02);
}

TEST_F(BoundsTest, WarnsOfCflOutOfBounds) {
  Scene scene = dam().scene;
  EXPECT_FALSE(warned(setupOf(scene), "solver.cfl"));
  scene.solver.cfl = 0.001;
  EXPECT_TRUE(warned(setupOf(scene), "solver.cfl: expected at least 0.01, found 0.001; 0.01 is used"));
  scene.solver.cfl = 2;
  EXPECT_FALSE(warned(setupOf(scene), "solver.cfl"));
  scene.solids = {Solid{.shape = MeshShape{.mesh = meshOf(boxMesh({0, 0, 0}, {1, 1, 1}))}}};
  EXPECT_TRUE(warned(setupOf(scene), "solver.cfl: expected at most 0.3 beside meshes, whose walls may be thin, found 2; 0.3 is used"));
  EXPECT_FALSE(warned(setupOf(scene), "solids[0].mesh: "));
  scene.solids = {Solid{.shape = MeshShape{.mesh = meshOf(boxMesh({0, 0, 0}, {1, 0.001, 1}))}}};
  EXPECT_TRUE(warned(setupOf(scene),
                     "solids[0].mesh: 4 triangles are on parts thinner than half a spacing, which may not hold fluid; "
                     "the thinnest is 0.001 m at ["));
}

TEST_F(BoundsTest, DisablesTensileThatReachesTheRestLatticeAndWarns) {
  Scene scene = dam().scene;
  EXPECT_GT(setupOf(scene).params.tensileRate, 0);
  EXPECT_FALSE(warned(setupOf(scene), "fluid.tensile"));
  for (const double radius : {0.48, 0.9, 1 - 1e-12}) {
    scene.fluid.tensile_radius = radius;
    EXPECT_EQ(setupOf(scene).params.tensileRate, 0) << radius;
    EXPECT_TRUE(warned(setupOf(scene), "fluid.tensile does nothing")) << radius;
  }
}

TEST_F(BoundsTest, TensilePreventsClumpingInASplash) {
  // Share of particles whose nearest neighbor is nearer than half a spacing, mean over a splash.
  const auto clumped = [&](double strength) {
    Trial t = dam();
    t.scene.fluid.tensile = strength;
    auto run = start(t);
    double clumps = 0, all = 0;
    for (int frame = 0; frame < 60; ++frame) {
      run->advance(1.0 / 60);
      const std::vector<glm::dvec3> x = run->snapshot().x;
      for (size_t i = 0; i < x.size(); ++i) {
        double nearest = 1e9;
        for (size_t j = 0; j < x.size(); ++j)
          if (j != i) nearest = std::min(nearest, glm::length(x[i] - x[j]));
        clumps += nearest < 0.5 * t.d();
        ++all;
      }
    }
    return clumps / all;
  };
  const double without = clumped(0), with = clumped(FluidSettings{}.tensile);
  EXPECT_GT(without, 0.005) << "nothing to keep apart";
  EXPECT_LT(with, 0.2 * without) << without;
}

// Particles that overlap at the start leave an overlap that a short step must not turn into speed.
TEST_F(BoundsTest, SettlesFurtherForShorterSteps) {
  Trial t = dam();
  t.scene.fluid.tensile = 0;  // which gives close pairs 0.3 m/s in that time
  t.x = block({6, 10, 6}, t.d(), {}, 0.4);
  t.settle = true;
  t.step = 2e-5;
  auto run = start(t);
  run->advance(1e-3);
  EXPECT_LT(run->snapshot().fastest(), 0.3) << "falling gives 0.01 m/s in that time";
}

TEST_F(BoundsTest, RejectsStepsTooShortForFloats) {
  Scene scene = dam().scene;
  scene.solver.time_step = 1e-9;
  const auto step = makeFluidSetup(scene, {.capacity = 360, .extent = {0.3, 0.6, 0.3}});
  ASSERT_FALSE(step);
  EXPECT_EQ(step.error().kind, ErrorKind::BadInput);
  EXPECT_TRUE(step.error().message.starts_with("solver.time_step: steps of 1e-09 s, ")) << step.error().message;
  scene.solver.time_step = 1e-5;
  EXPECT_TRUE(makeFluidSetup(scene, {.capacity = 360, .extent = {0.3, 0.6, 0.3}}));

  scene = {};
  scene.fluid.spacing = 0.01;
  EXPECT_TRUE(makeFluidSetup(scene, {.capacity = 8000, .extent = {500, 0.2, 0.2}})) << "two drops far apart";
  const auto wide = makeFluidSetup(scene, {.capacity = 8000, .extent = {5000, 0.2, 0.2}});
  ASSERT_FALSE(wide) << "so far that floats hardly tell places apart";
  EXPECT_TRUE(wide.error().message.starts_with("solver: in 1e+04 m of room this fluid")) << wide.error().message;
}

// The step of the fluid is for 1,000 kg/m^3 in each cube of a spacing, and a body has less for its surface.
TEST_F(BoundsTest, LightBodiesShortenStepsUnderTension) {
  Scene scene;
  scene.gravity = {};
  scene.fluid.spacing = 0.01;
  scene.fluid.surface_tension = 1;
  const double fluid = setupOf(scene).params.maxStep;
  scene.solids = {{.shape = BoxShape{{0, 0, 0}, {0.03, 0.03, 0.03}}, .body = Body{.density = 500}}};
  const std::string light = "solids[0].body with fluid.surface_tension 1 N/m: the body is light for its surface";
  const FluidSetup heavy = setupOf(scene);
  EXPECT_EQ(heavy.params.maxStep, float(fluid));
  EXPECT_EQ(heavy.stepBoundBy, "fluid.surface_tension 1 N/m");

  scene.solids[0].body->density = 50;
  const FluidSetup shorter = setupOf(scene);
  EXPECT_LT(shorter.params.maxStep, 0.9 * fluid);
  EXPECT_GT(shorter.params.maxStep, 0.2 * fluid);
  EXPECT_EQ(shorter.stepBoundBy, "solids[0].body with fluid.surface_tension 1 N/m");
  EXPECT_FALSE(warned(shorter, light));
  scene.solver.time_step = 0.9 * fluid;
  EXPECT_TRUE(warned(setupOf(scene), "solver.time_step ")) << "longer than the body allows";
  scene.solver.time_step = {};

  scene.solids[0].body->density = 0.1;
  const FluidSetup shortest = setupOf(scene);
  EXPECT_NEAR(shortest.params.maxStep, 0.1 * fluid, 1e-6 * fluid);
  EXPECT_TRUE(warned(shortest, light));
}

TEST_F(BoundsTest, NamesTensionThatNeedsTooShortSteps) {
  const StartFigures drops{.capacity = 8000, .extent = {1e5, 0.2, 0.2}};
  Scene scene;
  scene.gravity = {};
  scene.fluid.spacing = 0.01;
  EXPECT_TRUE(makeFluidSetup(scene, drops)) << "nothing asks for short steps";
  scene.fluid.surface_tension = 10;
  const auto one = makeFluidSetup(scene, drops);
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().kind, ErrorKind::BadInput);
  EXPECT_TRUE(one.error().message.starts_with("fluid.surface_tension 10 N/m: in 2e+05 m of room it allows steps of at most 0.002 s, "))
      << one.error().message;
  scene.solver.time_step = 1e-6;
  const auto shorter = makeFluidSetup(scene, drops);
  ASSERT_FALSE(shorter);
  EXPECT_TRUE(shorter.error().message.starts_with("solver.time_step: steps of 1e-06 s, ")) << shorter.error().message;
}

}  // namespace bounds_test
}  // namespace rill::test
