// Regions of a fluid fall asleep on their own: what substeps leave out, what wakes a region, and that the fluid ends where it would have
// without sleep.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "fluid/rig.hpp"
#include "fluid/sleep.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace regions_test {

constexpr double kFrame = 1.0 / 60;
constexpr glm::ivec3 kRoom = {64, 16, 4};
constexpr int kLayers = 6;
constexpr double kOpens = 10;  // s, the tap: all sleeps by then

/// A long tank with a tap over its low end. Its lattice is stable, so that it is at rest soon.
Trial channel() {
  Trial t = trial();
  t.scene.fluid.spacing = 0.02;
  t.scene.fluid.smoothing_ratio = 2;
  t.scene.solver = SolverSettings{};
  t.scene.solver.sleep = true;
  setWalls(t, glm::dvec3(kRoom) * t.d());
  t.step = kFrame;
  t.x = block({kRoom.x, kLayers, kRoom.z}, t.d());
  t.capacity = static_cast<uint32_t>(t.x.size()) + 200;
  t.scene.emitters = {{.mouth = DiscMouth{.center = {0.06, 0.2, 0.04}, .radius = 0.02, .normal = {0, -1, 0}},
                       .flow = 1e-4,
                       .from = kOpens,
                       .until = kOpens + 1.5}};
  return t;
}

std::vector<RegionRecord> regionsOf(const FluidSnapshot& s) {
  std::vector<RegionRecord> all(s.regions.size() / kRegionWords);
  std::memcpy(all.data(), s.regions.data(), s.regions.size() * 4);
  return all;
}

FluidControl controlOf(const FluidSnapshot& s) {
  FluidControl control;
  std::memcpy(&control, s.control.data(), sizeof control);
  return control;
}

double height(const Snapshot& s, double from, double until) {
  double sum = 0, count = 0;
  for (const glm::dvec3& x : s.x)
    if (x.x >= from && x.x < until) sum += x.y, ++count;
  return 2 * sum / count;
}

class RegionsTest : public FluidTest {
 protected:
  static void frames(Run& run, double seconds) {
    for (int frame = 0; frame < std::lround(seconds / kFrame); ++frame) run.advance(kFrame, 21);
  }
  static uint64_t sleeping(Run& run) { return run.stats().sleeping.value_or(0); }
  /// Of the channel, while the tap runs: a part of it sleeps.
  const FluidSnapshot& partlyAsleep() {
    static const FluidSnapshot state = afterOpening();
    return state;
  }
  FluidSnapshot afterOpening() {
    auto run = start(channel());
    frames(*run, kOpens + 0.3);
    const uint64_t asleep = sleeping(*run);
    EXPECT_GT(asleep, 0u);
    EXPECT_LT(asleep, run->fluid().count());
    return run->saved();
  }
};

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

// Bits are the same on each run: one that is saved and gone on with after each frame is the one that is not.
TEST_F(RegionsTest, SavingAndGoingOnChangesNothing) {
  const Trial t = channel();
  auto whole = start(t, &partlyAsleep());
  FluidSnapshot state = partlyAsleep();
  int due = 0;
  for (int frame = 0; frame < 20; ++frame) {
    frames(*whole, kFrame);
    auto run = start(t, &state);
    frames(*run, kFrame);
    state = run->saved();
    due += !hasNeighbors(state);
  }
  EXPECT_GT(due, 0);
  EXPECT_LT(due, 20);
  EXPECT_EQ(whole->saved(), state);
}

// The tap raises the level by most of a layer, so slowly that hardly anything moves: pressure has to wake what sleeps.
TEST_F(RegionsTest, EndsWhereItWouldWithoutSleep) {
  Trial t = channel();
  FluidSnapshot state = partlyAsleep();
  auto sleeps = start(t, &state);
  t.scene.solver.sleep = false;
  wake(state);
  state.regions.clear();
  auto never = start(t, &state);
  for (int k = 0; k < 28 && (k < 8 || sleeping(*sleeps) < sleeps->fluid().count() / 2); ++k) {
    frames(*sleeps, 0.5);
    frames(*never, 0.5);
  }
  EXPECT_GT(sleeping(*sleeps), sleeps->fluid().count() / 2 - 1);
  const FluidStats a = sleeps->stats(), b = never->stats();
  EXPECT_EQ(a.particles, b.particles);
  EXPECT_GT(a.particles, t.x.size());
  EXPECT_NEAR(a.potential_J, b.potential_J, 0.005 * b.potential_J);
  const Snapshot as = sleeps->snapshot(), bs = never->snapshot();
  const double quarter = kRoom.x / 4 * t.d();
  for (int part = 0; part < 4; ++part)
    EXPECT_NEAR(height(as, part * quarter, (part + 1) * quarter), height(bs, part * quarter, (part + 1) * quarter), 0.1 * t.d()) << part;
}

// Regions of a fluid that slept as a whole rested, also those that had not fallen asleep on their own.
TEST_F(RegionsTest, TapWakesItsOwnEndOfAFluidThatSlept) {
  const Trial t = channel();
  auto run = start(t);
  frames(*run, kOpens);
  EXPECT_EQ(sleeping(*run), t.x.size());
  const auto regions = regionsOf(run->saved());
  EXPECT_GT(std::ranges::count(regions, kRegionAwake, &RegionRecord::state), 0) << "not what this test is about";
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

// Fluid beside a solid stays awake: it may begin to move.
TEST_F(RegionsTest, FluidAtSolidsStaysAwake) {
  Trial t = channel();
  t.scene.emitters.clear();
  t.capacity = 0;
  t.scene.solids = {slab({0.2, -0.1, -0.1}, {0.24, 0.4, 0.4})};
  t.x.clear();
  addOutsideSolids(t, block({kRoom.x, kLayers, kRoom.z}, t.d()));
  auto run = start(t);
  FluidSnapshot s;
  const auto asleep = [&] { return s.rest.size() - std::ranges::count(s.rest, uint32_t{kZoneMoves}); };
  for (int k = 0; k < 60 && asleep() < t.x.size() / 3; ++k) {
    frames(*run, 0.25);
    s = run->saved();
  }
  size_t awake = 0;
  for (size_t i = 0; i < s.rest.size(); ++i) {
    const bool beside = std::abs(s.position[i].x - 0.22F) < 0.06F;
    awake += beside;
    EXPECT_TRUE(!beside || s.rest[i] == kZoneMoves) << i;
  }
  EXPECT_GT(awake, 0u);
  EXPECT_GE(asleep(), t.x.size() / 3);
}

// A box sinks into what sleeps: it wakes before the box is there, and bears it as water does.
TEST_F(RegionsTest, SolidThatComesWakesWhatItComesTo) {
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
