// Regions of a fluid fall asleep on their own: what substeps leave out, what wakes a region, and that the fluid ends where it would have
// without sleep.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "fluid/regions_fixture.hpp"

namespace rill::test {
namespace regions_test {

// What moves finds all of its neighbors among the particles that substeps are over, which the zones are made for.
TEST_F(RegionsTest, SubstepsAreOverWhatMovesAndWhatIsNearIt) {
  const Trial t = channel();
  const FluidSnapshot& s = partlyAsleep();
  auto run = start(t, &s);
  const FluidParams& p = implOf(run->fluid()).setup.params;
  const std::vector<uint32_t>& zones = s.rest;
  ASSERT_EQ(zones.size(), s.id.size());
  const uint32_t solved = controlOf(s).solved;
  EXPECT_LT(solved, s.id.size());
  EXPECT_EQ(solved, std::ranges::count_if(zones, [](uint32_t zone) { return zone != kZoneAsleep; }));
  const auto place = [&](size_t i) { return glm::dvec3(s.position[i].x, s.position[i].y, s.position[i].z); };
  size_t asleep = 0;
  for (size_t i = 0; i < zones.size(); ++i) {
    asleep += zones[i] != kZoneMoves;
    EXPECT_EQ(zones[i] == kZoneAsleep, i >= solved);
    EXPECT_TRUE(zones[i] == kZoneMoves || (s.velocity[i].x == 0 && s.velocity[i].y == 0 && s.velocity[i].z == 0));
    for (size_t j = 0; j < zones.size(); ++j) {
      const double distance = glm::length(place(i) - place(j));
      if (distance >= p.support) continue;
      EXPECT_LE(zones[j], zones[i] + 1);
    }
  }
  EXPECT_EQ(sleeping(*run), asleep);
}

// The zones are those of an independent computation from the regions' states.
TEST_F(RegionsTest, ZonesFollowFromTheDistanceToOneAwake) {
  const Trial t = channel();
  const FluidSnapshot& s = partlyAsleep();
  auto run = start(t, &s);
  const FluidParams& p = implOf(run->fluid()).setup.params;
  const std::vector<RegionRecord> regions = regionsOf(s);
  ASSERT_EQ(regions.size(), regionCount(p));
  const glm::ivec3 counts(p.regionsX, p.regionsY, p.regionsZ);
  const auto at = [&](size_t r) { return glm::ivec3(int(r) % counts.x, int(r) / counts.x % counts.y, int(r) / counts.x / counts.y); };
  for (size_t r = 0; r < regions.size(); ++r) {
    int nearest = kZoneAsleep;
    for (size_t q = 0; q < regions.size(); ++q) {
      if (regions[q].state != kRegionAwake && regions[q].woken == 0) continue;
      const glm::ivec3 apart = glm::abs(at(r) - at(q)), wrapped = glm::min(apart, counts - apart);
      nearest = std::min(nearest, std::max({wrapped.x, wrapped.y, wrapped.z}));
    }
    EXPECT_EQ(int(regions[r].zone), nearest) << r;
  }
}

TEST_F(RegionsTest, BitsAreTheSameAcrossACheckpointInEveryWayToGather) {
  for (Gather gather : gathersInTurn()) {
    SCOPED_TRACE(nameOf(gather));
    Trial t = channel();
    t.gather = gather;
    FluidSnapshot state = partlyAsleep();
    forgetNeighbors(state);  // each way has its own lists
    if (gather == Gather::Grid) state.listCapacity = 0;
    auto whole = start(t, &state);
    int due = 0, moved = 0;
    for (int frame = 0; frame < 12; ++frame) {
      frames(*whole, kFrame);
      const FluidSnapshot between = whole->saved();
      due += !hasNeighbors(between);
      moved += std::ranges::count(between.rest, uint32_t{kZoneWatched}) > 0;
      auto resumed = start(t, &between);
      whole = start(t, &between);
      frames(*whole, kFrame);
      resumed->advance(kFrame, 6);
      const FluidSnapshot a = whole->saved();
      EXPECT_EQ(a, resumed->saved()) << frame;
    }
    EXPECT_GT(moved, 0);
    EXPECT_LT(due, 12);
  }
}

TEST_F(RegionsTest, SavingAndGoingOnChangesNothing) { expectSavingChangesNothing(channel(), partlyAsleep()); }

// The tap raises the level by most of a layer, so slowly that hardly anything moves: pressure has to wake what sleeps.
TEST_F(RegionsTest, MatchesRunWithoutSleep) { expectEndWithoutSleep(channel(), partlyAsleep()); }

// Regions of a fluid that slept as a whole rested, also those that had not fallen asleep on their own: of some numbers of layers.
TEST_F(RegionsTest, TapWakesItsOwnEndOfAFluidThatSlept) {
  Trial t;
  std::unique_ptr<Run> run;
  bool mixed = false;
  for (const int layers : {10, 9, 8}) {  // which of them differs by rounding
    t = channel(layers);
    run = start(t);
    frames(*run, kOpens);
    const auto regions = regionsOf(run->saved());
    mixed = sleeping(*run) == t.x.size() && std::ranges::count(regions, kRegionAwake, &RegionRecord::state) > 0;
    if (mixed) break;
  }
  ASSERT_TRUE(mixed) << "not what this test is about";
  frames(*run, 0.05);
  const FluidSnapshot s = run->saved();
  ASSERT_EQ(s.rest.size(), s.id.size());
  size_t awake = 0;
  for (size_t i = 0; i < s.rest.size(); ++i) {
    if (s.rest[i] != kZoneMoves) continue;
    ++awake;
    EXPECT_TRUE(s.position[i].x < 0.4F || s.position[i].x > 1.2F) << i << ": " << s.position[i].x << " m; the grid wraps around";
  }
  EXPECT_GT(awake, 0u);
}

TEST_F(RegionsTest, GravityWakesAllAtItsTime) {
  Trial t = channel();
  t.scene.gravity_changes = {{1000, {1, -9.81, 0}}};
  const FluidSnapshot& state = partlyAsleep();
  t.scene.gravity_changes[0].at = controlOf(state).timeHigh + 2.5 * kFrame;
  auto run = start(t, &state);
  frames(*run, 2 * kFrame);
  EXPECT_GT(sleeping(*run), 0u);
  frames(*run, kFrame);
  EXPECT_EQ(sleeping(*run), 0u);
}

// Waking is no jolt: the pressure that bears what slept is still there.
TEST_F(RegionsTest, HostWakesBySnapshot) {
  Trial t = channel();
  t.scene.emitters[0].until = kOpens + 0.1;
  FluidSnapshot state = partlyAsleep();
  std::vector<uint32_t> slept;  // far from what moves
  for (size_t i = 0; i < state.rest.size(); ++i)
    if (state.rest[i] == kZoneAsleep) slept.push_back(state.id[i]);
  ASSERT_FALSE(slept.empty());
  wake(state);
  EXPECT_EQ(controlOf(state).solved, state.id.size());
  auto run = start(t, &state);
  frames(*run, kFrame);
  EXPECT_EQ(sleeping(*run), 0u);
  const Snapshot after = run->snapshot();
  for (uint32_t id : slept) EXPECT_LT(glm::length(after.v[id]), 0.02) << id;
}

TEST_F(RegionsTest, ChecksRegionsOfASnapshot) {
  const Trial t = channel();
  const FluidSnapshot& good = partlyAsleep();
  const auto refused = [&](const FluidSnapshot& s) {
    const Scene scene = t.timedScene();
    const ParticleSet particles = t.particles();
    const auto made = Fluid::create(rillDevice(), {.scene = &scene, .particles = &particles, .snapshot = &s, .capacity = t.capacity});
    return made ? std::string() : made.error().message;
  };
  const size_t zone = offsetof(RegionRecord, zone) / 4, rest = offsetof(RegionRecord, restShare) / 4;
  FluidSnapshot bad = good;
  bad.regions[zone] = 4;
  EXPECT_NE(refused(bad).find("regions[0] has a state that is not valid"), std::string::npos) << refused(bad);
  bad = good;
  bad.regions[rest + kRegionWords] = 0x7f800000;
  EXPECT_NE(refused(bad).find("regions[1]"), std::string::npos);
  bad = good;
  bad.regions.pop_back();
  EXPECT_NE(refused(bad).find("regions has"), std::string::npos);
  bad = good;
  bad.control[offsetof(FluidControl, solved) / 4] += 1;
  EXPECT_NE(refused(bad).find("come last"), std::string::npos);
}

}  // namespace regions_test
}  // namespace rill::test
