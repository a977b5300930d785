#pragma once
// A channel whose regions fall asleep on their own, with a tap over one end.
#include <cmath>
#include <cstring>
#include <vector>

#include "fluid/sleep.hpp"
#include "fluid/sleeping_trial.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace regions_test {

constexpr double kFrame = 1.0 / 60;
constexpr glm::ivec3 kRoom = {64, 16, 4};
constexpr int kLayers = 6;
constexpr double kOpens = 15.0;  // s, the tap: all sleeps by then, after 5 to 10 s

/// A long tank with a tap over its low end.
inline Trial channel(int layers = kLayers) {
  Trial t = sleepingTrial(kRoom, layers, kFrame);
  t.capacity = static_cast<uint32_t>(t.x.size()) + 200;
  t.scene.emitters = {{.mouth = DiscMouth{.center = {0.06, 0.2, 0.04}, .radius = 0.02, .normal = {0, -1, 0}},
                       .flow = 1e-4,
                       .from = kOpens,
                       .until = kOpens + 1.5}};
  return t;
}

inline std::vector<RegionRecord> regionsOf(const FluidSnapshot& s) {
  std::vector<RegionRecord> all(s.regions.size() / kRegionWords);
  std::memcpy(all.data(), s.regions.data(), s.regions.size() * 4);
  return all;
}

inline FluidControl controlOf(const FluidSnapshot& s) {
  FluidControl control;
  std::memcpy(&control, s.control.data(), sizeof control);
  return control;
}

inline double height(const Snapshot& s, double from, double until) {
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
    static const FluidSnapshot state = afterOpening(channel());
    return state;
  }
  FluidSnapshot afterOpening(const Trial& t) {
    auto run = start(t);
    frames(*run, kOpens + 0.3);
    const uint64_t asleep = sleeping(*run);
    EXPECT_GT(asleep, 0u);
    EXPECT_LT(asleep, run->fluid().count());
    return run->saved();
  }
  /// Bits are the same on each run: one that is saved and gone on with after each frame, with and without lists, is the one that is not.
  void expectSavingChangesNothing(const Trial& t, FluidSnapshot state) {
    auto whole = start(t, &state);
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
    FluidSnapshot saved = whole->saved();
    const size_t nearMouths = offsetof(FluidSums, nearMouths) / 4;  // after a checkpoint all may be near, until the next rebuild
    saved.sums[nearMouths] = state.sums[nearMouths];
    EXPECT_EQ(saved, state);
  }
  /// Goes on from `state` of a trial with and without sleep until half of it sleeps: what is where is the same.
  void expectEndWithoutSleep(Trial t, FluidSnapshot state) {
    auto sleeps = start(t, &state);
    t.scene.solver.sleep = false;
    wake(state);
    state.regions.clear();
    auto never = start(t, &state);
    for (int k = 0; k < 40 && (k < 8 || sleeping(*sleeps) < sleeps->fluid().count() / 2); ++k) {
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
};

}  // namespace regions_test
}  // namespace rill::test
