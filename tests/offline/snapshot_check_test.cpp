// Snapshots that do not fit a scene, or that shaders could not follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fluid/snapshot.hpp"
#include "support/checkpoint_seed.hpp"

namespace rill::test {
namespace {

class SnapshotCheck : public ::testing::Test {
 protected:
  void expectRejected(const char* words) {
    const auto checked = checkSnapshot(s, wanted);
    ASSERT_FALSE(checked) << words;
    EXPECT_NE(checked.error().message.find(words), std::string::npos) << checked.error().message;
    s = good;
  }
  FluidSnapshot good = seedCheckpoint().fluid, s = good;
  SnapshotShape wanted = seedShape();
};

class BodySnapshotCheck : public SnapshotCheck {
 protected:
  void SetUp() override {
    s = good = seedCheckpointWithBodies().fluid;
    wanted = seedShapeWithBodies();
  }
  static void set(std::vector<uint32_t>& words, size_t at, float value) { words[at] = std::bit_cast<uint32_t>(value); }
};

TEST_F(BodySnapshotCheck, AcceptsMatchingScene) {
  const auto checked = checkSnapshot(s, wanted);
  EXPECT_TRUE(checked) << checked.error().message;
}

TEST_F(BodySnapshotCheck, RejectsOtherCountsOfBodies) {
  s.bodies.resize(kBodyWords);
  expectRejected("bodies has 52 entries; expected 104");
  s.bodies.clear();
  expectRejected("bodies has 0 entries; expected 104");
  s.slips.pop_back();
  expectRejected("slips has 14 entries; expected 15");
  EXPECT_FALSE(checkSnapshot(s, seedShape())) << "a scene without bodies";
  EXPECT_FALSE(checkSnapshot(seedCheckpoint().fluid, wanted)) << "a snapshot without bodies";
}

TEST_F(BodySnapshotCheck, RejectsMotionsThatAreNotValid) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float value : {nan, inf, -inf, 1e30f}) {
    for (const size_t word : {offsetof(PoseRecord, centerX), offsetof(PoseRecord, velocityY), offsetof(PoseRecord, angularZ),
                              offsetof(BodyRecord, predicted) + offsetof(PoseRecord, velocityX), offsetof(BodyRecord, stiffness)}) {
      set(s.bodies, kBodyWords + word / 4, value);
      expectRejected("bodies[1] has a motion that is not valid");
    }
    if (std::isfinite(value)) continue;
    set(s.slips, 2 * kSlipWords + 3, value);
    expectRejected("slips[2] is not finite");
  }
  set(s.bodies, offsetof(PoseRecord, rotationW) / 4, 0.5f);
  expectRejected("bodies[0] has a motion that is not valid; expected finite numbers and a unit quaternion");
  set(s.bodies, offsetof(BodyRecord, stiffness) / 4, -1);
  expectRejected("bodies[0]");
}

TEST_F(BodySnapshotCheck, RejectsMassesThatAreNotValid) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float value : {nan, inf, -inf, 0.0f, -2.0f}) {
    set(s.bodies, kBodyWords + offsetof(BodyRecord, mass) / 4, value);
    expectRejected("bodies[1]");
  }
}

TEST_F(SnapshotCheck, RejectsReadingsOfPressureThatAreNotValid) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<uint32_t> probe = s.pressures;
  ASSERT_EQ(probe.size(), kPressureProbeWords);
  good.pressures.insert(good.pressures.end(), probe.begin(), probe.end());
  s = good;
  EXPECT_TRUE(checkSnapshot(s, wanted)) << "readings of probes that the scene does not have are of no use";
  const auto set = [&](size_t offset, uint32_t word) { s.pressures[kPressureProbeWords + offset / 4] = word; };
  for (const float value : {nan, inf, -inf})
    for (const size_t offset : {offsetof(PressureProbeRecord, x), offsetof(PressureProbeRecord, z), offsetof(PressureProbeRecord, mean),
                                offsetof(PressureProbeRecord, integralHigh), offsetof(PressureProbeRecord, integralLow),
                                offsetof(PressureProbeRecord, advance), offsetof(PressureProbeRecord, advanceTime)}) {
      set(offset, std::bit_cast<uint32_t>(value));
      expectRejected("pressures[1]");
    }
  set(offsetof(PressureProbeRecord, advanceTime), std::bit_cast<uint32_t>(-1e-3f));
  expectRejected("pressures[1]");
  set(offsetof(PressureProbeRecord, covered), 2);
  expectRejected("pressures[1]");
  s.pressures.pop_back();
  expectRejected("pressures has 17 entries; expected a multiple of 9");
  s.pressures.clear();
  EXPECT_TRUE(checkSnapshot(s, wanted)) << "of a run without probes";
}

TEST_F(SnapshotCheck, AcceptsMatchingScene) {
  const auto checked = checkSnapshot(s, seedShape());
  EXPECT_TRUE(checked) << checked.error().message;
}

TEST_F(SnapshotCheck, AcceptsSnapshotWithoutWarmStart) {
  s.warmAcceleration.clear();
  expectRejected("warmacc has 0 entries");
  s.warmAcceleration.clear();
  s.warmStart.clear();
  const auto checked = checkSnapshot(s, seedShape());
  EXPECT_TRUE(checked) << checked.error().message;
}

TEST_F(SnapshotCheck, AcceptsSparseIdsAndFewerParticlesThanCapacity) {
  s.id[1] = 1000;
  SnapshotShape larger = seedShape();
  larger.capacity = 100;
  for (const SnapshotShape& shape : {seedShape(), larger}) {
    const auto checked = checkSnapshot(s, shape);
    EXPECT_TRUE(checked) << checked.error().message;
  }
}

TEST_F(SnapshotCheck, RejectsImagesWhereThereAreNoSegments) {
  s.neighbors[3] = kImageOfNeighbors;
  EXPECT_TRUE(checkSnapshot(s, seedShape()));
  SnapshotShape without = seedShape();
  without.segments = false;
  EXPECT_FALSE(checkSnapshot(s, without));
}

TEST_F(SnapshotCheck, RejectsMoreParticlesThanCapacity) {
  SnapshotShape smaller = seedShape();
  smaller.capacity = 5;
  const auto checked = checkSnapshot(s, smaller);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("has 6 particles; expected at most 5"), std::string::npos) << checked.error().message;
}

// Every value that shaders use as an index.
TEST_F(SnapshotCheck, RejectsInvalidIndices) {
  s.id[1] = s.id[0];
  expectRejected("an id appears twice");
  s.id[1] = kMaxIds;
  expectRejected("its largest id is 2130706432; expected less than 2130706432");
  s.nearSolids.push_back(s.nearSolids[0]);
  expectRejected("near solids");
  s.nearSolids[0].particle = 1000;
  expectRejected("near solids");
  s.nearSolids[1] = s.nearSolids[0];
  expectRejected("near solids");
  constexpr uint16_t kEnd = 0xffff;
  for (const auto& solids : {std::array<uint16_t, 3>{kEnd, kEnd, kEnd}, {1, kEnd, kEnd}, {0, 0, kEnd}, {0, kEnd, 0}}) {
    std::ranges::copy(solids, s.nearSolids[0].solids.begin());
    expectRejected("a list of solids that is not valid");
  }
  s.neighbors[0] = static_cast<uint32_t>(s.id.size());
  expectRejected("a neighbor index is out of range");
  s.neighbors[0] = kImageOfNeighbors + kSegmentImages;
  expectRejected("a neighbor index is out of range");
  s.neighbors[4] = kImageOfNeighbors + 1;  // of a particle whose list begins without an image
  expectRejected("images of a particle's neighbors are not in order");
  s.neighbors[3] = kImageOfNeighbors + 2;
  s.neighbors[4] = kImageOfNeighbors + 1;
  expectRejected("images of a particle's neighbors are not in order");
  s.neighbors.pop_back();
  expectRejected("neighbors has");
  std::swap(s.neighbors[3], s.neighbors[6]);  // 5 before 0: a step back takes an entry of its own
  expectRejected("increasing order");
  s.neighborCount[0] = seedShape().listCapacity + 1;
  expectRejected("neighbors has");
  s.neighborCount.pop_back();
  expectRejected("neighbor counts has");
  s.cell.back() = static_cast<uint32_t>(seedShape().cells);
  expectRejected("cells");
  s.cell.front() = s.cell.back() + 1;
  expectRejected("cells");
  s.cell.clear();
  expectRejected("cells");
  s.listCapacity += 4;
  expectRejected("lists hold");
  s.control[offsetof(FluidControl, listState) / 4] = kListNone;
  expectRejected("control block");
  for (const uint32_t phase : {kPhaseSettling, kPhaseInitialPressure, kPhaseInitialPressure + 1}) {
    for (const uint32_t left : {0u, 1u << 30}) {
      s.control[offsetof(FluidControl, nextPhase) / 4] = phase;
      s.control[offsetof(FluidControl, phaseLeft) / 4] = left;
      expectRejected("control block");
    }
  }
  s.control[offsetof(FluidControl, phaseLeft) / 4] = 1;
  expectRejected("control block");
  s.control[offsetof(FluidControl, phase) / 4] = kPhaseInitialPressure + 1;
  expectRejected("control block");
  s.control.clear();
  expectRejected("control has 0 entries");
  s.sums[offsetof(FluidSums, nearSolids) / 4] = 5;
  expectRejected("near solids");
  s.warmAcceleration.pop_back();
  expectRejected("warmacc has");
  s.solids.push_back(0);
  expectRejected("solids has");
}

}  // namespace
}  // namespace rill::test
