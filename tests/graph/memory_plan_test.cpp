#include "graph/memory_plan.hpp"

#include <gtest/gtest.h>

namespace rill::test {
namespace {

constexpr uint64_t kLimit = 4096;

std::vector<uint64_t> plan(std::vector<Placement>& placements, uint64_t limit = kLimit) {
  MemoryPlanner planner;
  std::vector<uint64_t> heaps;
  planner.plan(placements, limit, heaps);
  return heaps;
}

TEST(MemoryPlan, DisjointLifetimesShareMemory) {
  std::vector<Placement> p{{0, 1, 1000}, {1, 2, 1000}, {2, 3, 1000}, {3, 4, 1000}};
  EXPECT_EQ(plan(p), std::vector<uint64_t>{1024 + 1000});
  EXPECT_EQ(p[0].offset, 0u);
  EXPECT_EQ(p[1].offset, 1024u) << "offsets are multiples of 256";
  EXPECT_EQ(p[2].offset, 0u);
  EXPECT_EQ(p[3].offset, 1024u);
}

TEST(MemoryPlan, FillsTheFirstGapThatFits) {
  std::vector<Placement> p{{0, 9, 256}, {0, 1, 512}, {0, 9, 256}, {2, 9, 512}, {3, 9, 256}};
  EXPECT_EQ(plan(p), std::vector<uint64_t>{1024 + 256});
  EXPECT_EQ(p[3].offset, 256u);
  EXPECT_EQ(p[4].offset, 1024u);
}

TEST(MemoryPlan, NoHeapExceedsTheLimit) {
  std::vector<Placement> p{{0, 9, 4096}, {0, 9, 3000}, {0, 9, 3000}, {0, 9, 1024}};
  EXPECT_EQ(plan(p), (std::vector<uint64_t>{4096, 4096, 3000}));
  EXPECT_EQ(p[3].heap, 1u) << "fits beside the second";
  EXPECT_EQ(p[3].offset, 3072u);
}

TEST(MemoryPlan, OrdersByFirstUseNotDeclaration) {
  std::vector<Placement> p{{5, 6, 256}, {0, 1, 256}};
  EXPECT_EQ(plan(p), std::vector<uint64_t>{256});
}

TEST(MemoryPlan, EmptyPlanHasNoHeap) {
  std::vector<Placement> p;
  EXPECT_TRUE(plan(p).empty());
}

}  // namespace
}  // namespace rill::test
