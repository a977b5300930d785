// Viscosity as an implicit step: momenta, degenerate input, and no bound on the step.
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"

namespace rill::test {
namespace viscosity_test {

using ViscosityTest = FluidTest;

/// A ball of fluid in free space.
Trial blob(double viscosity) {
  Trial t = trial();
  t.scene.gravity[1] = 0;
  t.scene.fluid.viscosity = viscosity;
  for (const glm::dvec3& x : block({9, 9, 9}, t.d(), glm::dvec3(-4.5 * t.d()), 0.05))
    if (glm::length(x) < 4.5 * t.d()) t.x.push_back(x);
  return t;
}

TEST_F(ViscosityTest, RotatingBlobKeepsItsAngularMomentum) {
  for (const double viscosity : {10.0, 1e4}) {
    Trial t = blob(viscosity);
    t.step = 4e-3;
    for (const glm::dvec3& x : t.x) t.v.push_back(glm::cross(glm::dvec3(0.3, 1, -0.5), x));
    auto run = start(t);
    const auto angular = [&] {
      const Snapshot s = run->snapshot();
      glm::dvec3 sum(0);
      for (size_t i = 0; i < s.x.size(); ++i) sum += glm::cross(s.x[i], s.v[i]);
      return sum;
    };
    run->substeps(1);  // settles, which moves particles without time
    const glm::dvec3 before = angular();
    for (int n = 0; n < 5; ++n) run->substeps(50);
    EXPECT_LT(glm::length(angular() - before), 0.005 * glm::length(before)) << viscosity;
    EXPECT_EQ(run->stats().viscosityBoundHits, 0u) << viscosity;
  }
}

/// A jittered block with noise, an isolated pair and a lone particle.
Trial degenerate(double viscosity) {
  Trial t = trial();
  t.scene.fluid.viscosity = viscosity;
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.x.insert(t.x.end(), {{0.9, 0.9, 0.9}, {0.7, 0.8, 0.2}, {0.76, 0.8, 0.2}});
  t.v = randomCloud(t.x.size(), 2.0, 5, glm::dvec3(-1.0));
  return t;
}

TEST_F(ViscosityTest, DegenerateInputMatchesReference) {
  for (const double viscosity : {1e-3, 10.0, 1e3, 1e5}) {
    SCOPED_TRACE(viscosity);
    expectEqual(degenerate(viscosity), 2, 1e-3, 1e-3);
  }
}

TEST_F(ViscosityTest, StaysFiniteBeyondItsBound) {
  for (const double viscosity : {1e8, 1e38}) {
    SCOPED_TRACE(viscosity);
    Trial t = degenerate(viscosity);
    t.x[40] = t.x[41];
    auto run = start(t);
    const double before = run->stats().kinetic_J;
    run->substeps(20);
    EXPECT_TRUE(run->snapshot().finite());
    EXPECT_LT(run->stats().kinetic_J, before);
    EXPECT_GT(run->stats().viscosityBoundHits, 0u);
  }
}

TEST_F(ViscosityTest, DoesNotShortenTheStep) {
  Scene scene = degenerate(0).timedScene();
  scene.solver.time_step.reset();
  const StartFigures start{.capacity = 255, .extent = {1, 1, 1}};
  const auto water = makeFluidSetup(scene, start);
  for (const double viscosity : {10.0, 1e4}) {
    scene.fluid.viscosity = viscosity;
    const auto thick = makeFluidSetup(scene, start);
    ASSERT_TRUE(water && thick);
    EXPECT_EQ(thick->longestStep, water->longestStep) << viscosity;
    EXPECT_EQ(thick->warnings, water->warnings) << viscosity;
  }
}

}  // namespace viscosity_test
}  // namespace rill::test
