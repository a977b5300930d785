// Springs that pull rigid bodies.
#include <limits>
#include <numbers>

#include "fluid/bodies_fixture.hpp"

namespace rill::test {
namespace bodies_test {

/// Springs on all bodies that act on points off their centers, one of them as hard as it may.
std::vector<BodyPull> pullsOnAll(const Trial& t) {
  std::vector<BodyPull> pulls;
  for (uint32_t n = 0; n < t.scene.solids.size(); ++n)
    if (t.scene.solids[n].body)
      pulls.push_back({.solid = n, .point = {0.05, -0.04, 0.03}, .target = {0.6, 0.9, 0.45}, .frequency_Hz = 1.5, .dampingRatio = 0.4});
  pulls[0].maxForce = 10;
  pulls.push_back({.solid = pulls[0].solid, .point = {-0.05, 0.02, 0}, .target = {0.2, 0.5, 0.5}, .frequency_Hz = 4});
  return pulls;
}

TEST_F(BodiesTest, PullsMatchReference) {
  for (Trial t : {crowded(), dry()}) {
    t.pulls = pullsOnAll(t);
    t.scene.solids[1].body->locked = 0b010010;  // along y, about y
    const bool inFluid = !t.x.empty();
    expectReferenceMotion(t, inFluid ? 4 : 25, inFluid ? 1e-3 : 2e-3);
  }
}

/// A ball in free fall without fluid, on a spring.
Trial pulled(double frequency, double dampingRatio) {
  Trial t = trial();
  t.capacity = 1;
  t.step = 2e-3;
  t.scene.gravity[1] = 0;
  t.scene.solids = {body(ball({0, 0, 0}, 0.1), 500)};
  t.pulls = {{.solid = 0, .target = {0.3, 0.2, -0.1}, .frequency_Hz = frequency, .dampingRatio = dampingRatio}};
  return t;
}

TEST_F(BodiesTest, PulledOnesFollowTheDampedOscillator) {
  const double rate = 2 * std::numbers::pi;
  const glm::dvec3 target(0.3, 0.2, -0.1);
  auto critical = start(pulled(1, 1)), light = start(pulled(1, 0.1));
  for (const double t : {0.15, 0.3}) {  // implicit steps damp a little more
    runFor(*critical, 0.15);
    runFor(*light, 0.15);
    EXPECT_LT(glm::length(vec(motion(*critical, 0).center) - (1 - (1 + rate * t) * std::exp(-rate * t)) * target),
              0.02 * glm::length(target));
    const double damped = std::sqrt(0.99) * rate;
    const double left = std::exp(-0.1 * rate * t) * (std::cos(damped * t) + 0.1 * rate / damped * std::sin(damped * t));
    EXPECT_LT(glm::length(vec(motion(*light, 0).center) - (1 - left) * target), 0.04 * glm::length(target));
  }
}

TEST_F(BodiesTest, CriticallyDampedPullsSettleWithoutOvershoot) {
  for (const double frequency : {4.0, 1e6}) {  // the last is stiff at any step
    SCOPED_TRACE(frequency);
    Trial t = pulled(frequency, 1);
    t.step = 5e-3;
    const glm::dvec3 target = vec(t.pulls[0].target);
    auto run = start(t);
    for (int n = 0; n < 6; ++n) {
      runFor(*run, 0.1);
      EXPECT_LT(glm::dot(vec(motion(*run, 0).center), target), (1 + 1e-5) * glm::dot(target, target)) << n;
    }
    EXPECT_LT(glm::length(vec(motion(*run, 0).center) - target), 1e-4);
    run->pulls.clear();
    runFor(*run, 0.05);
    EXPECT_LT(glm::length(vec(motion(*run, 0).center) - target), 1e-3) << "released";
  }
}

TEST_F(BodiesTest, PullsKeepToTheirForceAndLockedDegrees) {
  Trial t = pulled(1000, 1);
  t.scene.solids.push_back(body(slab({1, 0, 0}, {1.2, 0.2, 0.2}), 500));
  t.scene.solids[1].body->locked = 0b111110;  // free along x
  t.scene.solids.push_back(body(ball({3, 0, 0}, 0.1), 500));
  t.scene.solids[2].body->from = 10;
  t.pulls[0].maxForce = 3;
  t.pulls.push_back({.solid = 1, .point = {0.1, 0.1, 0.1}, .target = {1.5, 4, 7}, .frequency_Hz = 5});
  t.pulls.push_back({.solid = 2, .target = {5, 5, 5}});
  auto run = start(t);
  runFor(*run, 0.2);
  const double mass = massOf(t.scene.solids[0]).mass;
  EXPECT_NEAR(glm::length(vec(motion(*run, 0).velocity)), 0.2 * 3 / mass, 1e-3 * 0.2 * 3 / mass);
  runFor(*run, 0.3);
  EXPECT_NEAR(motion(*run, 1).center.x, 1.4, 1e-3) << "its point is at the target along x";
  EXPECT_EQ(motion(*run, 1).center.y, 0.1f);
  EXPECT_EQ(motion(*run, 1).rotation, (Quaternion{0, 0, 0, 1}));
  EXPECT_EQ(motion(*run, 2).center, (Double3{3, 0, 0}));
}

// Bits do not depend on pieces, and pulls are no part of a snapshot.
TEST_F(BodiesTest, PullsGoOnFromASnapshotBitForBit) {
  Trial t = crowded();
  t.pulls = pullsOnAll(t);
  auto run = start(t), pieces = start(t);
  run->substeps(40);
  pieces->substeps(40, 4);
  const FluidSnapshot middle = run->saved();
  EXPECT_EQ(middle.bodies, pieces->saved().bodies);
  auto other = start(t, &middle);
  for (Run* each : {run.get(), other.get()}) each->substeps(20);
  EXPECT_EQ(run->saved(), other->saved());
  for (Run* each : {run.get(), other.get()}) {
    each->pulls.clear();
    each->substeps(20);
  }
  EXPECT_EQ(run->saved(), other->saved());
  Trial free = t;
  free.pulls.clear();
  auto released = start(free, &middle), kept = start(t, &middle);
  released->substeps(20);
  kept->substeps(20);
  EXPECT_NE(released->saved().bodies, kept->saved().bodies);
}

TEST_F(BodiesTest, RejectInvalidPulls) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Trial t = pulled(1, 1);
  t.scene.solids.push_back(ball({2, 0, 0}, 0.1));
  auto run = start(t);
  const auto message = [&](std::vector<BodyPull> pulls, bool queued = false) {
    Graph graph;
    (void)run->fluid().addTo(graph, {.advance_s = 0.01, .pulls = pulls, .queued = queued});
    const auto compiled = graph.compile();
    return compiled ? std::string("compiled") : compiled.error().message;
  };
  EXPECT_EQ(message({{.solid = 0}, {.solid = 2}}), "FluidStep::pulls[1].solid is 2; the scene has 2 solids");
  EXPECT_EQ(message({{.solid = 1}}), "FluidStep::pulls[0].solid is 1, which is not a body; expected the index of a solid with a body");
  EXPECT_EQ(message({{.point = {0, nan, 0}}}), "FluidStep::pulls[0].point is [0, nan, 0]; expected finite numbers (m)");
  EXPECT_EQ(message({{.target = {0, 0, BodyPull::kNoBound}}}), "FluidStep::pulls[0].target is [0, 0, inf]; expected finite numbers (m)");
  EXPECT_EQ(message({{.frequency_Hz = 0}}), "FluidStep::pulls[0].frequency_Hz is 0; expected a number above 0, at most 1e6 (Hz)");
  EXPECT_EQ(message({{.dampingRatio = -1}}), "FluidStep::pulls[0].dampingRatio is -1; expected a number from 0 to 1e6");
  EXPECT_EQ(message({{.maxForce = nan}}), "FluidStep::pulls[0].maxForce is nan; expected a number above 0 (N)");
  EXPECT_EQ(message(std::vector<BodyPull>(65)), "FluidStep::pulls has 65 entries; expected at most 64");
  EXPECT_EQ(message({{}}, true), "FluidStep::queued is set; expected false where bodies are pulled");
  run->pulls = {{.target = {1e300, -1e300, 0}, .frequency_Hz = 1e6, .dampingRatio = 1e6, .maxForce = 1e300}};
  run->substeps(5);
  run->read({});
  EXPECT_TRUE(std::isfinite(motion(*run, 0).center.x));
}

}  // namespace bodies_test
}  // namespace rill::test
