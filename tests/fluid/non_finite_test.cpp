// Particles that are not numbers: inactive, counted, and never noticed by the others.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/rig.hpp"

namespace rill::test {
namespace non_finite_test {

// Takes out every particle of `broken`, which is not finite.
Trial without(const Trial& t, const std::vector<size_t>& broken) {
  Trial rest = t;
  rest.x.clear();
  rest.v.clear();
  for (size_t i = 0; i < t.x.size(); ++i) {
    if (std::find(broken.begin(), broken.end(), i) != broken.end()) continue;
    rest.x.push_back(t.x[i]);
    rest.v.push_back(t.v[i]);
  }
  return rest;
}

class NonFiniteTest : public FluidTest {
 protected:
  NonFiniteTest() {
    t.x = block({6, 7, 6}, t.d(), {}, 0.1);
    t.v = randomCloud(t.x.size(), 0.4, 5, glm::dvec3(-0.2));
    setWalls(t, {1, 1, 1});
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    t.x[3].y = nan;
    t.x[50].x = infinite;
    t.x[51].z = -infinite;
    t.v[100].x = nan;
    t.v[200].z = -infinite;
    t.v[201].y = infinite;
    t.v[202] = glm::dvec3(1e30);  // finite, but not its square
  }
  bool isBroken(size_t i) const { return std::find(broken.begin(), broken.end(), i) != broken.end(); }
  void expectOthersLike(const Snapshot& all, const Snapshot& rest) {
    size_t next = 0;
    for (size_t i = 0; i < all.x.size(); ++i) {
      if (isBroken(i)) continue;
      EXPECT_EQ(all.x[i], rest.x[next]) << i;
      EXPECT_EQ(all.v[i], rest.v[next]) << i;
      ++next;
    }
  }

  Trial t = trial();
  std::vector<size_t> broken = {3, 50, 51, 100, 200, 201, 202};
};

TEST_F(NonFiniteTest, DoesNotChangeOtherParticles) {
  for (Gather gather : kGathers) {
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t), clean = start(without(t, broken));
    run->substeps(20);
    clean->substeps(20);
    const FluidStats stats = run->stats();
    EXPECT_EQ(stats.nonFinite, broken.size());
    EXPECT_EQ(stats.loopBoundHits, 0u);
    EXPECT_TRUE(run->measured().finite());
    expectOthersLike(run->snapshot(), clean->snapshot());
  }
}

TEST_F(NonFiniteTest, DoesNotChangeOtherParticlesWithForces) {
  t.scene.solver.iterations = 3;
  t.scene.fluid.viscosity = 10;
  t.scene.fluid.vorticity = 0.3;
  t.scene.fluid.surface_tension = 0.5;
  t.scene.fluid.tensile = 0.5;
  t.scene.solids = {ball({0.2, 0.7, 0.2}, 0.15)};
  auto run = start(t), clean = start(without(t, broken));
  run->substeps(10);
  clean->substeps(10);
  EXPECT_EQ(run->stats().nonFinite, broken.size());
  expectOthersLike(run->snapshot(), clean->snapshot());
}

TEST_F(NonFiniteTest, DoesNotChangeFigures) {
  auto run = start(t), clean = start(without(t, broken));
  run->substeps(5);
  clean->substeps(5);
  const FluidStats a = run->stats(), b = clean->stats();
  EXPECT_EQ(a.nonFinite, broken.size());
  EXPECT_EQ(b.nonFinite, 0u);
  EXPECT_EQ(a.outside, broken.size());
  EXPECT_NEAR(a.densityErrorMean, b.densityErrorMean, 1e-6);
  EXPECT_EQ(a.densityErrorP99, b.densityErrorP99);
  EXPECT_EQ(a.densityErrorMax, b.densityErrorMax);
  EXPECT_EQ(a.densitySignedMedian, b.densitySignedMedian);
  EXPECT_EQ(a.maxSpeed, b.maxSpeed);
  EXPECT_NEAR(a.kinetic_J, b.kinetic_J, 1e-5 * b.kinetic_J);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a.centerOfMass[axis], b.centerOfMass[axis], 1e-6) << axis;
}

TEST_F(NonFiniteTest, DoesNotChangeTheStep) {
  t.scene.solver.tolerance = 0.05;  // of the water; the step follows it by half a percent a substep
  t.step = 0.01;
  for (Gather gather : {Gather::Texel, Gather::Grid}) {
    t.gather = gather;
    SCOPED_TRACE(nameOf(gather));
    auto run = start(t), clean = start(without(t, broken));
    run->advance(0.8);
    clean->advance(0.8);
    const uint32_t steps = run->progress().substeps, usual = clean->progress().substeps;
    EXPECT_LE(steps, usual + usual / 20);
    EXPECT_GE(steps, usual - usual / 20);
  }
}

TEST_F(NonFiniteTest, HandlesOnlyNonFiniteParticles) {
  for (glm::dvec3& x : t.x) x.x = std::numeric_limits<double>::quiet_NaN();
  auto run = start(t);
  run->substeps(3);
  const FluidStats stats = run->stats();
  EXPECT_EQ(stats.nonFinite, t.x.size());
  EXPECT_EQ(stats.densityErrorMean, 0);
  EXPECT_TRUE(std::isfinite(stats.centerOfMass[0]));
  EXPECT_TRUE(run->measured().finite());
}

}  // namespace non_finite_test
}  // namespace rill::test
