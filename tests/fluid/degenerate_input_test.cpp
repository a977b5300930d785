// What no scene should contain and some will: lone and lost particles; thin tanks; places far from zero. See crowded_input_test.cpp and
// non_finite_test.cpp, too.
#include "fluid/degenerate_input.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace rill::test {
namespace degenerate_input_test {

// Symplectic Euler's parabola x0 + n dt v + n (n + 1) / 2 dt^2 g. All numbers are sums of few powers of two: only the step is rounded,
// where a device's division is (2.5 ulp are allowed).
TEST_F(DegenerateInputTest, LoneParticleFollowsTheParabola) {
  Trial t = trial();
  t.step = 1.0 / 1024;
  t.scene.gravity[1] = -8;
  t.x = {{0.5, 2, 0.25}};
  t.v = {{1, 0.5, 0}};
  for (Gather gather : kGathers) {
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t);
    for (int n : {1, 10, 100}) {
      run = start(t);
      run->substeps(n);
      const Snapshot s = run->snapshot();
      EXPECT_LT(glm::length(s.v[0] - glm::dvec3(1, 0.5 - 8 * n * t.step, 0)), 1e-6) << n;
      EXPECT_LT(glm::length(s.x[0] - glm::dvec3(0.5 + n * t.step, 2 + 0.5 * n * t.step - 4.0 * n * (n + 1) * t.step * t.step, 0.25)), 1e-6)
          << n;
      EXPECT_NEAR(run->progress().time_s, n * t.step, 1e-7);
    }
  }
}

TEST_F(DegenerateInputTest, ParticlesAtTheSupportRadiusDoNotInteract) {
  for (KernelChoice kernel : {KernelChoice::Wendland, KernelChoice::Poly6Spiky}) {
    Trial t = trial();
    t.scene.solver.kernel = kernel;
    t.scene.fluid.smoothing_ratio = 2;
    t.scene.gravity[1] = 0;
    const double h = 2 * t.d();  // a power of two
    const SmoothingKernel k(kernel, h, t.d());
    t.x = {{0.25, 0.25, 0.25}, {0.25 + h, 0.25, 0.25}};
    auto run = start(t);
    run->substeps(3);
    run->stats();
    for (double density : run->measured().density) EXPECT_NEAR(density, k.value(0), 1e-7);
    EXPECT_EQ(run->measured().x, t.x);
    EXPECT_EQ(run->measured().fastest(), 0);
    t.x[1].x -= 0.5 * h;
    run = start(t);
    run->stats();
    for (double density : run->measured().density) EXPECT_NEAR(density, k.value(0) + k.value(0.5 * h), 1e-6);
  }
}

TEST_F(DegenerateInputTest, HandlesZeroParticles) {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  auto run = start(t);
  run->advance(0.25);
  EXPECT_TRUE(run->progress().known);
  EXPECT_EQ(run->progress().time_s, 0.25);
  EXPECT_EQ(run->progress().timeLeft_s, 0);
  run->advance(0.25);
  const FluidStats s = run->stats();
  EXPECT_EQ(s.particles, 0u);
  EXPECT_EQ(s.time_s, 0.5);
  EXPECT_EQ(s.densityErrorMean, 0);
  EXPECT_EQ(s.kinetic_J, 0);
  EXPECT_TRUE(run->snapshot().x.empty());
  EXPECT_EQ(run->fluid().count(), 0u);
}

TEST_F(DegenerateInputTest, DoesNotDependOnTheOrigin) {
  Trial t = trial();
  t.x = block({5, 6, 5}, t.d(), {}, 0.1);
  const auto finish = [&](double origin) {
    for (double& o : t.origin) o = origin;
    setWalls(t, {0.75, 1, 0.5});
    const double c = origin + 0.375;
    t.scene.solids = {ball({c, origin + 0.5, origin + 0.25}, 0.125)};
    auto run = start(t);
    run->substeps(20);
    const FluidStats stats = run->stats();
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(stats.centerOfMass[a] - origin, 0.2, 0.2);
    return run->snapshot();
  };
  const Snapshot near = finish(0), far = finish(1048576);
  EXPECT_EQ(near, far);
  const Snapshot odd = finish(1e6);
  EXPECT_EQ(near, odd);
}

TEST_F(DegenerateInputTest, ParticlesLeaveThroughOpenSides) {
  Trial t = trial();
  setWalls(t, {0.5, 0.5, 0.5}, 0b000010);
  t.x = block({6, 6, 6}, t.d(), {0.1, 0, 0.05});
  t.x.push_back({0.45, 0.4, 0.25});
  t.v.assign(t.x.size(), glm::dvec3(0));
  t.v.back() = {100, 0, 0};
  for (Gather gather : kGathers) {
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t);
    run->substeps(20);
    const FluidStats stats = run->stats();
    const Snapshot& s = run->measured();
    size_t beyond = 0;
    for (const glm::dvec3& x : s.x) beyond += x.x > 0.5;
    EXPECT_EQ(stats.outside, beyond);
    EXPECT_GE(beyond, 1u);
    EXPECT_EQ(stats.nonFinite, 0u);
    EXPECT_NEAR(s.x.back().x, 0.45 + 100 * 20 * t.step, 1e-3);
    EXPECT_TRUE(s.finite());
  }
}

// Beyond what floats can tell apart, nothing moves any more, and other particles are unharmed.
TEST_F(DegenerateInputTest, DeactivatesParticlesThatFlyAway) {
  Trial t = trial();
  t.scene.fluid.spacing = 1.0 / 1024;
  t.scene.gravity[1] = 0;
  t.x = block({5, 5, 5}, t.d());
  t.x.push_back({976, 0, 0});
  t.v.assign(t.x.size(), glm::dvec3(0));
  t.v.back() = {4000, 0, 0};
  t.scene.solver.cfl = 10;  // let it fly
  auto run = start(t);
  run->substeps(40);
  const FluidStats stats = run->stats();
  const Snapshot& s = run->measured();
  EXPECT_TRUE(s.finite());
  EXPECT_EQ(stats.nonFinite, 0u);
  EXPECT_GT(s.x.back().x, 1e6 * t.d() - 0.1);
  EXPECT_LT(s.x.back().x, 1e6 * t.d() + 10);
  for (size_t i = 0; i + 1 < s.x.size(); ++i) EXPECT_LT(glm::length(s.x[i] - t.x[i]), 0.5 * t.d());
}

TEST_F(DegenerateInputTest, MovesParticlesBeyondWallsInside) {
  Trial t = trial();
  t.scene.solver.cfl = 0.25;
  t.scene.gravity[1] = 0;
  setWalls(t, {0.75, 0.75, 0.75});
  t.x = block({4, 4, 4}, t.d(), {0.25, 0, 0.25});
  t.x.insert(t.x.end(), {{-0.2, 0.3, 0.3}, {0.3, -1, 0.3}, {0.76, 0.5, 0.1}, {-3, -3, 9}, {0.0, 0.0, 0.0}, {0.75, 0.75, 0.75}});
  for (Gather gather : kGathers) {
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t);
    run->substeps(1);
    const Snapshot first = run->snapshot();
    EXPECT_TRUE(first.finite());
    EXPECT_EQ(outsideOf(t, first), 0u);
    // They are put there: that is no motion.
    EXPECT_LE(first.fastest(), 1.001 * 2 * 0.25 * t.d() / run->control().step);
    run->substeps(30);
    const FluidStats stats = run->stats();
    EXPECT_EQ(outsideOf(t, run->measured()), 0u);
    EXPECT_EQ(stats.outside, 0u);
  }
}

// Walls nearer to each other than a spacing leave each center one place on that axis.
TEST_F(DegenerateInputTest, HandlesVeryThinDomain) {
  for (double thickness : {0.3, 0.7, 1.0, 1.5}) {
    SCOPED_TRACE(thickness);
    Trial t = trial();
    t.scene.solver.cfl = 0.25;
    setWalls(t, {0.75, 0.75, thickness * t.d()});
    t.x = block({8, 8, 1}, t.d(), {}, 0.1);
    for (glm::dvec3& x : t.x) x.z = 0.4 * thickness * t.d();
    auto run = start(t);
    run->advance(0.2);
    const FluidStats stats = run->stats();
    const Snapshot& s = run->measured();
    ASSERT_TRUE(s.finite());
    EXPECT_EQ(outsideOf(t, s), 0u);
    EXPECT_EQ(stats.outside, 0u);
    // What falls the height of the tank; below a spacing the block starts crushed, and no step takes it out: walls alone measure too much.
    EXPECT_LT(s.fastest(), thickness >= 1 ? std::sqrt(2 * 9.81 * 0.75) : 1.001 * 2 * 0.25 * t.d() / run->control().step);
    if (thickness > 1) continue;
    for (const glm::dvec3& x : s.x) EXPECT_NEAR(x.z, 0.5 * thickness * t.d(), 1e-6);
  }
}

TEST_F(DegenerateInputTest, HandlesDomainForOneParticle) {
  Trial t = trial();
  setWalls(t, glm::dvec3(0.5 * t.d()));
  t.x = {{0, 0.01, 0.02}};
  t.v = {{3, -4, 5}};
  auto run = start(t);
  run->substeps(5);
  const Snapshot s = run->snapshot();
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(s.x[0][a], 0.25 * t.d(), 1e-6);
  EXPECT_LT(s.fastest(), 1e-3);
}

}  // namespace degenerate_input_test
}  // namespace rill::test
