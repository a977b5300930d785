// Neighbor lists and cells of snapshots, in the device's layout and back.
#include <gtest/gtest.h>

#include "fluid/neighbor_list.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace {

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
