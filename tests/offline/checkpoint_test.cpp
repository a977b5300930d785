// Checkpoint files: round trips and errors.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "fluid/neighbor_list.hpp"
#include "fluid/snapshot.hpp"
#include "rill/offline.hpp"
#include "support/checkpoint_seed.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

using offline::Checkpoint;

std::string decodeError(std::span<const std::byte> bytes) {
  const auto read = offline::decodeCheckpoint(bytes, "run.rill");
  if (read) return "";
  EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
  return read.error().message;
}

TEST(CheckpointFile, RoundTrips) {
  for (const Checkpoint& c : {seedCheckpoint(), seedCheckpointWithBodies()}) {
    const auto bytes = offline::encodeCheckpoint(c);
    const auto read = offline::decodeCheckpoint(bytes, "run.rill");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, c);
    EXPECT_EQ(offline::encodeCheckpoint(*read), bytes);
  }
  const Checkpoint nothing;
  const auto empty = offline::decodeCheckpoint(offline::encodeCheckpoint(nothing), "run.rill");
  ASSERT_TRUE(empty) << empty.error().message;
  EXPECT_EQ(*empty, nothing);
}

TEST(CheckpointFile, RejectsTruncationAnywhere) {
  const auto bytes = offline::encodeCheckpoint(seedCheckpointWithBodies());
  for (size_t size = 1; size < bytes.size(); ++size) {
    const std::string why = decodeError(std::span(bytes).first(size));
    EXPECT_NE(why.find("is truncated"), std::string::npos) << size << ": " << why;
  }
  EXPECT_NE(decodeError({}).find("not a Rill checkpoint"), std::string::npos);
  auto longer = bytes;
  longer.push_back({});
  EXPECT_NE(decodeError(longer).find("is corrupted: found"), std::string::npos) << decodeError(longer);
}

TEST(CheckpointFile, RejectsAnyFlippedBit) {
  auto bytes = offline::encodeCheckpoint(seedCheckpoint());
  for (size_t at = 0; at < bytes.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      bytes[at] ^= static_cast<std::byte>(1 << bit);
      EXPECT_NE(decodeError(bytes), "") << "byte " << at << ", bit " << bit;
      bytes[at] ^= static_cast<std::byte>(1 << bit);
    }
}

TEST(CheckpointFile, DistinguishesForeignAndNewerFiles) {
  const std::string image = "\x89PNG\r\n\x1a\n and so on and so on";
  EXPECT_NE(decodeError(std::as_bytes(std::span(image))).find("is not a Rill checkpoint"), std::string::npos);
  const auto checkpoint = offline::encodeCheckpoint(seedCheckpoint());
  const int format = std::to_integer<int>(checkpoint[8]);
  const auto expectRejected = [&](int other, const char* age) {
    auto bytes = checkpoint;
    bytes[8] = std::byte(other);
    seal(bytes);
    const std::string what = age + (" Rill: found format " + std::to_string(other)) + ", expected " + std::to_string(format);
    EXPECT_NE(decodeError(bytes).find(what), std::string::npos) << decodeError(bytes);
  };
  expectRejected(format + 1, "a newer");
  expectRejected(format - 1, "an older");
}

// The checksum is valid, so that the lengths themselves are checked.
TEST(CheckpointFile, RejectsInvalidLengths) {
  const auto whole = offline::encodeCheckpoint(seedCheckpoint());
  uint32_t sections = 0;
  std::memcpy(&sections, whole.data() + 12, 4);
  ASSERT_GT(sections, 10u);
  for (uint64_t wrong : {uint64_t{1}, uint64_t{1} << 40, ~uint64_t{0}, ~uint64_t{7}, uint64_t{1} << 63}) {
    for (size_t row = 0; row < sections; ++row) {
      auto bytes = whole;
      std::memcpy(bytes.data() + 24 + 16 * row + 8, &wrong, 8);
      seal(bytes);
      EXPECT_NE(decodeError(bytes).find("is corrupted"), std::string::npos) << row << ": " << wrong;
    }
    auto bytes = whole;
    std::memcpy(bytes.data() + 16, &wrong, 8);  // of the whole file
    EXPECT_NE(decodeError(bytes), "");
    bytes = whole;
    std::memcpy(bytes.data() + 24 + 16 * sections, &wrong, 8);  // of the first text
    seal(bytes);
    EXPECT_NE(decodeError(bytes).find("is corrupted"), std::string::npos) << wrong;
  }
}

TEST(CheckpointFile, RejectsUnprintableKeys) {
  Checkpoint c = seedCheckpoint();
  c.keys[0].second = "\x1b[2J";
  EXPECT_NE(decodeError(offline::encodeCheckpoint(c)).find("is corrupted"), std::string::npos)
      << "control characters would reach a terminal";
}

TEST(CheckpointFile, LoadsFromDisk) {
  const TemporaryFolder folder;
  const auto bytes = offline::encodeCheckpoint(seedCheckpoint());
  const auto file = folder.write("run.rill", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  const auto read = offline::loadCheckpoint(file);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, seedCheckpoint());
  for (const auto& [path, words] : {std::pair{folder / "none", "does not exist"}, std::pair{folder.path(), "is not a regular file"},
                                    std::pair{std::filesystem::path("/dev/zero"), "is not a regular file"}}) {
    const auto missing = offline::loadCheckpoint(path);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find(words), std::string::npos) << missing.error().message;
  }
  const auto other = folder.write("other", std::string(1 << 20, 'x'));
  EXPECT_NE(offline::loadCheckpoint(other).error().message.find("not a Rill checkpoint"), std::string::npos);
}

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

TEST(SnapshotNeighborList, RoundTripsThroughBlockLayout) {
  FluidSnapshot s;
  s.listCapacity = 8;
  const uint32_t count = 3 * kListBlock + 17;
  s.id.resize(count);
  for (uint32_t i = 0; i < count; ++i) {
    s.neighborCount.push_back(i % 10);  // some exceed the capacity, by one
    for (uint32_t k = 0; k < i % 10 && i % 10 <= 8; ++k) s.neighbors.push_back((i * 7) % (count - 8) + k);
  }
  FluidSnapshot back = s;
  back.neighbors.clear();
  back.neighborCount.clear();
  const std::vector<uint32_t> heads = layOutHeads(s);
  for (const auto& [first, last] : {std::pair{0u, 2 * kListBlock}, std::pair{2 * kListBlock, count}}) {
    std::vector<uint32_t> list(8 * kListBlock * 2 / 2, 0xdead);
    layOutList(s, first, last, list);
    if (first == 0) {  // particle 4097 has seven neighbors in a row: block 1, second group, padded
      const size_t at = ((kListBlock * 2 + 1) + kListBlock) * 2;
      EXPECT_EQ(list[at], 1u | 1u << 16);
      EXPECT_EQ(list[at + 1], 1u | kLongStep << 16);
    }
    gatherList(back, first, last, heads, list);
  }
  EXPECT_EQ(back, s);
}

// A step of 16 bits reaches no farther than 61,439 particles; two entries reach any.
TEST(SnapshotNeighborList, ReachesDistantNeighbors) {
  const uint32_t far = kMaxParticles - 1;
  for (const uint32_t i : {0u, 1u, 100000u, far}) {
    FluidSnapshot s;
    s.listCapacity = 12;
    const std::vector<uint32_t> neighbors = {0, kLongStep - 1, 2 * kLongStep - 1, 2 * kLongStep, 3000000, far - 1, far};
    EXPECT_LE(listEntries(i, neighbors), 11u);
    EXPECT_GE(listEntries(i, neighbors), 9u);
    const std::vector<uint32_t> none;
    EXPECT_EQ(listEntries(i, none), 0u);
  }
  FluidSnapshot s;
  s.listCapacity = 12;
  s.id.resize(4);
  s.neighborCount = {3, 1, 0, 3};
  s.neighbors = {1, 2 * kLongStep, far, far, 5, 3, far};  // the last goes back, and on again
  FluidSnapshot back = s;
  back.neighbors.clear();
  back.neighborCount.clear();
  std::vector<uint32_t> list(12 * kListBlock / 2);
  layOutList(s, 0, 4, list);
  gatherList(back, 0, 4, layOutHeads(s), list);
  EXPECT_EQ(back, s);
}

// Near walls a list is made of segments, each with an image of the neighbors.
TEST(SnapshotNeighborList, RoundTripsImages) {
  constexpr uint32_t kImage = kImageOfNeighbors;
  FluidSnapshot s;
  s.listCapacity = 24;
  s.id.resize(5);
  s.neighborCount = {8, 4, 0, 2, 25};
  s.neighbors = {kImage, 1, 2, 3, 4, kImage + 1, 0, 3, kImage + 3, 1, kImage + 26, 0, 0, 1};
  FluidSnapshot back = s;
  back.neighbors.clear();
  back.neighborCount.clear();
  EXPECT_EQ(listEntries(0, std::span(s.neighbors).first(8)), 8u + 4u) << "whole groups";
  const std::vector<uint32_t> heads = layOutHeads(s);
  EXPECT_TRUE(heads[0] & kSegmentsBit);
  EXPECT_FALSE(heads[3] & kSegmentsBit);
  std::vector<uint32_t> list(24 * kListBlock / 2, 0xdead);
  layOutList(s, 0, 5, list);
  EXPECT_EQ(list[0] & 0xFFFF, kLongStep | 2u) << "image 0, two groups";
  gatherList(back, 0, 5, heads, list);
  EXPECT_EQ(back, s);
}

TEST(SnapshotCells, RecoverTheirStarts) {
  std::vector<uint32_t> start(7);
  cellStarts(std::vector<uint32_t>{1, 1, 4}, start);
  EXPECT_EQ(start, (std::vector<uint32_t>{0, 0, 2, 2, 2, 3, 3}));
}

}  // namespace
}  // namespace rill::test
