// Rigid bodies from snapshots and from degenerate input.
#include <bit>
#include <cstring>
#include <stdexcept>

#include "fluid/bodies_fixture.hpp"

namespace rill::test {
namespace bodies_test {

TEST_F(BodiesTest, GoOnFromASnapshotBitForBit) {
  Trial released = crowded();
  for (Solid& solid : released.scene.solids) solid.body->from = 0.05;
  for (const Trial& t : {crowded(), dry(), pyramid(), released}) {
    auto run = start(t);
    run->substeps(100);
    const FluidSnapshot middle = run->saved();
    run->substeps(20);
    auto other = start(t, &middle);
    other->substeps(20);
    const FluidSnapshot one = run->saved(), two = other->saved();
    EXPECT_EQ(one.position, two.position);
    EXPECT_EQ(one.bodies, two.bodies);
    EXPECT_EQ(one.slips, two.slips);
  }
}

size_t slipsOf(const FluidSnapshot& s) {
  size_t partners = 0;
  for (size_t word = 0; word < s.slips.size(); word += kSlipWords) partners += s.slips[word] != 0;
  return partners;
}

// Points that may touch nothing are not tested, but for once after they may have touched something.
TEST_F(BodiesTest, EndTheSlipsOfWhatASnapshotHasLifted) {
  Trial t = trial();
  t.capacity = 1;
  setWalls(t, {2, 2, 1});
  t.scene.solids = {crate({0.5, 0.15, 0.5}, 0.3)};
  t.step = 2e-3;
  auto run = start(t);
  run->substeps(20);
  FluidSnapshot lifted = run->saved();
  ASSERT_GT(slipsOf(lifted), 0u);
  BodyRecord body;
  std::memcpy(&body, lifted.bodies.data(), sizeof body);
  EXPECT_EQ(body.mayTouch, 1u);
  body.state.centerY += 1;
  std::memcpy(lifted.bodies.data(), &body, sizeof body);
  auto flying = start(t, &lifted);
  flying->substeps(1);
  EXPECT_EQ(slipsOf(flying->saved()), 0u);
}

TEST_F(BodiesTest, RejectSnapshotsThatAreNotFinite) {
  const Trial t = pyramid();
  auto run = start(t);
  run->substeps(20);
  const FluidSnapshot good = run->saved();
  for (const uint32_t word : {0x7fc00000U, 0x7f800000U, 0x7f000000U}) {
    FluidSnapshot bodies = good, slips = good;
    bodies.bodies[1] = word;
    EXPECT_THROW(start(t, &bodies), std::runtime_error);
    slips.slips[2] = word;
    if (std::isfinite(std::bit_cast<float>(word))) continue;
    EXPECT_THROW(start(t, &slips), std::runtime_error);
  }
  FluidSnapshot named = good;
  named.slips[0] = 0xffffffffU;  // names no solid
  auto other = start(t, &named);
  other->substeps(10);
  EXPECT_TRUE(std::isfinite(motion(*other, 0).center.y));
}

/// Finite, within the walls, and no faster than what was there.
void expectSane(const BodyMotion& m, double fastest, const glm::dvec3& size, double radius) {
  for (size_t a = 0; a < 3; ++a) {
    EXPECT_TRUE(std::isfinite(m.center[a]) && std::isfinite(m.velocity[a]) && std::isfinite(m.angularVelocity[a]));
    EXPECT_GT(m.center[a], -radius);
    EXPECT_LT(m.center[a], size[static_cast<int>(a)] + radius);
  }
  EXPECT_LT(glm::length(vec(m.velocity)), fastest);
}

TEST_F(BodiesTest, HandleDegenerateInput) {
  const glm::dvec3 size(1, 1, 1);
  struct Case {
    const char* name;
    std::vector<Solid> solids;
    double fastest;
  };
  Solid locked = crate({0.5, 0.5, 0.5}, 0.3);
  locked.body->locked = 0b111111;
  Solid spinning = crate({0.5, 0.5, 0.5}, 0.3);
  spinning.body->angular_velocity = {1000, 0, 0};
  const std::vector<Case> cases = {
      {"one within another", {crate({0.5, 0.3, 0.5}, 0.3), crate({0.5, 0.3, 0.5}, 0.3), body(ball({0.5, 0.3, 0.5}, 0.1), 100)}, 10},
      {"in a wall", {crate({0, 0, 0.5}, 0.3), body(ball({1, 0.5, 1}, 0.2), 100)}, 10},
      {"larger than the domain", {crate({0.5, 0.5, 0.5}, 3)}, 10},
      {"mass ratios", {crate({0.5, 0.15, 0.5}, 0.3, 1), crate({0.5, 0.46, 0.5}, 0.3, 1e6)}, 20},
      {"fast", {body(ball({0.2, 0.5, 0.5}, 0.1), 500, {100, 0, 0}), crate({0.6, 0.5, 0.5}, 0.2)}, 110},
      {"locked", {locked, crate({0.5, 0.7, 0.5}, 0.2)}, 10},
      {"spinning", {spinning}, 200},
      {"tiny", {crate({0.5, 0.5, 0.5}, 1e-3), body(ball({0.5, 0.5, 0.5}, 1e-4), 1)}, 100},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    Trial t = trial();
    setWalls(t, size);
    t.scene.solids = c.solids;
    addOutsideSolids(t, block({16, 6, 16}, t.d(), {0, 0, 0}, 0.02));
    if (t.x.empty()) t.capacity = 1;
    auto run = start(t);
    run->substeps(200);
    EXPECT_TRUE(run->snapshot().finite());
    for (size_t n = 0; n < c.solids.size(); ++n) expectSane(motion(*run, n), c.fastest, size, boundingRadius(c.solids[n].shape));
  }
}

}  // namespace bodies_test
}  // namespace rill::test
