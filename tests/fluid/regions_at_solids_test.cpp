// Regions of a fluid beside solids: where they sleep, what holds them awake, and that what sleeps is as it would be awake.
#include <algorithm>
#include <cmath>

#include "fluid/regions_fixture.hpp"

namespace rill::test {
namespace regions_test {

/// A shoal in the channel, 2.5 spacings high.
constexpr float kShoal = 0.05F;
Trial channelWithShoal() {
  Trial t = channel();
  t.scene.solids = {slab({0.3, -0.1, -0.1}, {0.56, kShoal, 0.2})};
  t.x.clear();
  addOutsideSolids(t, block({kRoom.x, kLayers, kRoom.z}, t.d()));
  t.capacity = static_cast<uint32_t>(t.x.size()) + 200;
  return t;
}

/// A drain that is open, and dry, keeps the fluid as a whole awake, so that only its regions sleep.
Trial channelWithPillar() {
  Trial t = channel();
  t.scene.emitters.clear();
  t.scene.drains = {{.shape = BoxShape{{1.2, 0.28, 0}, {1.26, 0.31, 0.08}}}};
  t.capacity = 0;
  t.scene.solids = {slab({0.2, -0.1, -0.1}, {0.24, 0.4, 0.4})};
  t.x.clear();
  addOutsideSolids(t, block({kRoom.x, kLayers, kRoom.z}, t.d()));
  return t;
}

/// How many particles sleep: of those at the pillar, which are `beside` it, and of all.
struct Asleep {
  size_t beside = 0, atPillar = 0, all = 0;
};

class RegionsAtSolidsTest : public RegionsTest {
 protected:
  const FluidSnapshot& shoalPartlyAsleep() {
    static const FluidSnapshot state = afterOpening(channelWithShoal());
    return state;
  }
  /// Once a quarter of all sleep, or after 15 s. Two pillars that keep regions awake leave 30 % that can.
  static Asleep asleepAtPillar(Run& run, const std::vector<float>& pillars = {0.22F}) {
    Asleep found;
    for (int k = 0; k < 60 && 4 * found.all < run.fluid().count(); ++k) {
      frames(run, 0.25);
      const FluidSnapshot s = run.saved();
      found = {};
      for (size_t i = 0; i < s.rest.size(); ++i) {
        const bool beside = std::ranges::any_of(pillars, [&](float x) { return std::abs(s.position[i].x - x) < 0.06F; });
        const bool asleep = s.rest[i] != kZoneMoves;
        found.beside += beside;
        found.atPillar += beside && asleep;
        found.all += asleep;
      }
    }
    EXPECT_GT(found.beside, 0u);
    EXPECT_GE(4 * found.all, run.fluid().count());
    return found;
  }
};

// It may begin to move, or its load is that of fluid awake.
TEST_F(RegionsAtSolidsTest, FluidStaysAwakeAtSolidsThatMoveOrBearLoads) {
  Trial driven = channelWithPillar(), loaded = channelWithPillar();
  driven.scene.solids[0].driven = 1;
  loaded.loads = true;
  EXPECT_EQ(asleepAtPillar(*start(driven)).atPillar, 0u);
  EXPECT_EQ(asleepAtPillar(*start(loaded)).atPillar, 0u);
}

// One whose keyframes are over may be given others, and a body that is held will be released.
TEST_F(RegionsAtSolidsTest, FluidStaysAwakeAtKeyframedSolidsAndHeldBodies) {
  Trial t = channelWithPillar();
  t.scene.solids.push_back(slab({0.34, -0.1, -0.1}, {0.38, 0.4, 0.4}));
  t.scene.solids[0].motion = {{0.5, {0.005, 0, 0}}, {1, {0, 0, 0}}};
  t.scene.solids[1].body = Body{.density = 500, .from = 100};
  t.x.clear();
  addOutsideSolids(t, block({kRoom.x, kLayers, kRoom.z}, t.d()));
  EXPECT_EQ(asleepAtPillar(*start(t), {0.22F, 0.36F}).atPillar, 0u);
}

TEST_F(RegionsAtSolidsTest, FluidSleepsAtSolidsThatCannotMove) {
  const Asleep found = asleepAtPillar(*start(channelWithPillar()));
  EXPECT_GT(2 * found.atPillar, found.beside);
}

// Figures see what sleeps at solids as what does not.
TEST_F(RegionsAtSolidsTest, DensityAtSolidsIsThatOfFluidAwake) {
  const Trial t = channelWithShoal();
  auto run = start(t, &shoalPartlyAsleep());
  const FluidSnapshot& s = shoalPartlyAsleep();
  run->stats();
  const Snapshot& now = run->measured();
  size_t asleep = 0;
  for (size_t i = 0; i < s.rest.size(); ++i) {
    const Float3& x = s.position[i];
    if (s.rest[i] == kZoneMoves || x.x < 0.32F || x.x > 0.54F || x.y > kShoal + 1.5F * 0.02F) continue;
    ++asleep;
    EXPECT_NEAR(now.density[s.id[i]], 1, 0.03) << s.id[i];
  }
  EXPECT_GT(asleep, 20u);
}

TEST_F(RegionsAtSolidsTest, MatchesRunWithoutSleep) { expectEndWithoutSleep(channelWithShoal(), shoalPartlyAsleep()); }

TEST_F(RegionsAtSolidsTest, SavingAndGoingOnChangesNothing) {
  Trial t = channelWithShoal();
  t.scene.solids.push_back(slab({0.9, -0.1, -0.1}, {0.94, 0.4, 0.04}));
  t.scene.solids[1].driven = 1;  // holds fluid awake
  t.x.clear();
  addOutsideSolids(t, block({kRoom.x, kLayers, kRoom.z}, t.d()));
  expectSavingChangesNothing(t, afterOpening(t));
}

// A box sinks into what sleeps: it wakes before the box is there, and bears it as water does.
TEST_F(RegionsAtSolidsTest, ApproachingSolidWakesRegions) {
  Trial t = channel();
  t.scene.emitters.clear();
  t.capacity = 0;
  t.loads = true;
  Solid box = slab({1.0, 0.2, 0.02}, {1.06, 0.26, 0.06});
  box.motion = {{kOpens, {0, 0, 0}}, {kOpens + 0.5, {0, -0.12, 0}}};
  t.scene.solids = {box};
  auto run = start(t);
  frames(*run, kOpens);
  EXPECT_EQ(sleeping(*run), t.x.size());
  double largest = 0;
  uint64_t least = t.x.size();
  for (int frame = 0; frame < 36; ++frame) {
    frames(*run, kFrame);
    const auto& force = run->fluid().solidLoads()[0].force;
    largest = std::max(largest, std::hypot(force[0], force[1], force[2]));
    least = std::min(least, sleeping(*run));
  }
  EXPECT_LT(least, t.x.size());
  EXPECT_GT(largest, 0.2);
  EXPECT_LT(largest, 10) << "N; its buoyancy is 1.4";
}

// A box that is held over what sleeps falls into it: only its end of the channel wakes at once, and it floats as in fluid awake.
TEST_F(RegionsAtSolidsTest, ReleasedBodyWakesRegions) {
  Trial t = channel();
  t.scene.emitters.clear();
  t.capacity = 0;
  Solid box = slab({0.1, 0.18, 0.01}, {0.16, 0.24, 0.07});
  box.body = Body{.density = 500, .from = kOpens};
  t.scene.solids = {box};
  auto run = start(t);
  frames(*run, kOpens);
  EXPECT_EQ(sleeping(*run), t.x.size());
  const auto middle = [&] {
    run->read({});
    return run->fluid().bodies()[0].center.y;
  };
  EXPECT_NEAR(middle(), 0.21, 1e-6);
  frames(*run, 0.15);
  EXPECT_GT(sleeping(*run), 0u);
  EXPECT_LT(sleeping(*run), t.x.size());
  frames(*run, 0.8);
  EXPECT_NEAR(middle(), kLayers * t.d() + 0.5 * std::pow(0.06, 3) / (kRoom.x * kRoom.z * t.d() * t.d()), 0.01);
}

}  // namespace regions_test
}  // namespace rill::test
