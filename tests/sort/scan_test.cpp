// The scan against std::exclusive_scan.
#include "sort/scan.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "sort/rig.hpp"
#include "sort/sort_types.h"

namespace rill::test {
namespace {

class ScanTest : public SortTest {
 protected:
  Words scanned(const Words& values, bool storageReads = false);
};

Words ScanTest::scanned(const Words& values, bool storageReads) {
  auto scan = Scan::create(device(), static_cast<uint32_t>(values.size()), storageReads);
  if (!scan) throw std::runtime_error(scan.error().message);
  const WordBuffer inPlace = words(values);
  runGraph([&](Graph& graph) { scan->addTo(graph, inPlace.in(graph, "values")); });
  return inPlace.copy();
}

TEST_F(ScanTest, MatchesReferenceAroundTileSizes) {
  std::mt19937 random(1);
  for (uint32_t count : {1u, 2u, 63u, 64u, 65u, 127u, 128u, 129u, 2047u, 2048u, 2049u, 16383u, 16384u, 16385u, 100000u, 1000003u,
                         kScanSums * kScanTile, kScanSums * kScanTile + 1}) {
    Words values(count), wanted(count);
    for (uint32_t& value : values) value = static_cast<uint32_t>(random());  // sums wrap
    std::exclusive_scan(values.begin(), values.end(), wanted.begin(), 0u);
    for (const bool storageReads : {false, true}) EXPECT_TRUE(scanned(values, storageReads) == wanted) << count << ", " << storageReads;
  }
}

TEST_F(ScanTest, ScansMoreTilesThanOneTileHolds) {
  // More tiles than one tile has values.
  Words values(5000000, 1), wanted(5000000);
  std::iota(wanted.begin(), wanted.end(), 0u);
  for (const bool storageReads : {false, true}) EXPECT_TRUE(scanned(values, storageReads) == wanted) << storageReads;
}

TEST_F(ScanTest, AcceptsZeroAndRejectsTooManyValues) {
  auto scan = Scan::create(device(), 0);
  ASSERT_TRUE(scan);
  EXPECT_TRUE(scan->groups().empty());
  Graph graph;
  EXPECT_EQ(scan->addTo(graph, BufferRef{}), BufferRef{});
  EXPECT_FALSE(Scan::create(device(), Scan::kMaxCount + 1));
}

}  // namespace
}  // namespace rill::test
