// Both sorts against std::stable_sort.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "sort/rig.hpp"
#include "sort/sort_types.h"

namespace rill::test {
namespace {

constexpr uint64_t kAllBits = uint64_t{1} << 32;

const char* name(SortMethod method) { return method == SortMethod::Counting ? "counting" : method == SortMethod::Radix ? "radix" : "auto"; }

Words randomKeys(uint32_t count, uint64_t keyRange) {
  std::mt19937 random(count + static_cast<uint32_t>(keyRange));
  Words keys(count);
  for (uint32_t& key : keys) key = static_cast<uint32_t>(random() % keyRange);
  return keys;
}

class KeySortTest : public SortTest {
 protected:
  /// Sorts and compares all outputs.
  void check(SortMethod method, const Words& keys, uint64_t keyRange);
};
class BothSorts : public KeySortTest, public testing::WithParamInterface<SortMethod> {};
INSTANTIATE_TEST_SUITE_P(, BothSorts, testing::Values(SortMethod::Counting, SortMethod::Radix),
                         [](const auto& test) { return std::string(name(test.param)); });

void KeySortTest::check(SortMethod method, const Words& keys, uint64_t keyRange) {
  const bool table = keyRange <= 16u << 20;
  const Sorted wanted = expected(keys, keyRange, table);
  for (const bool storageReads : {false, true}) {
    const KeySortDesc desc{static_cast<uint32_t>(keys.size()), keyRange, method, table, true, storageReads};
    const Sorted got = sorted(desc, keys);
    const std::string what = std::string(name(method)) + ", " + std::to_string(keys.size()) + " keys below " + std::to_string(keyRange) +
                             (storageReads ? ", read through storage buffers" : "");
    EXPECT_TRUE(got.order == wanted.order) << what;
    EXPECT_TRUE(got.keys == wanted.keys) << what;
    EXPECT_TRUE(got.start == wanted.start) << what;
  }
}

TEST_P(BothSorts, SortsCountsAroundWorkgroupAndTileSizes) {
  for (uint32_t count : {1u, 2u, 3u, 63u, 64u, 65u, 255u, 256u, 257u, 511u, 512u, 513u, 1000u, 4095u, 4096u, 4097u, 65535u, 65536u, 65537u})
    check(GetParam(), randomKeys(count, 1000), 1000);
}

TEST_P(BothSorts, SortsEveryKeyWidth) {
  for (uint64_t keyRange : {1u, 2u, 3u, 63u, 64u, 65u, 128u, 4096u, 4097u, 8192u, 16384u, 16385u, 262144u, 262145u, 1u << 21})
    check(GetParam(), randomKeys(5000, keyRange), keyRange);
}

TEST_P(BothSorts, SortsAMillionKeys) { check(GetParam(), randomKeys(1000000, 300000), 300000); }

TEST_P(BothSorts, SortsAscendingDescendingAndFewDistinctKeys) {
  constexpr uint32_t kCount = 10000;
  Words rising(kCount), falling(kCount), few(kCount), sparse(kCount);
  for (uint32_t i = 0; i < kCount; ++i) {
    rising[i] = i;
    falling[i] = kCount - 1 - i;
    few[i] = i * 7 % 3 * 4000;
    sparse[i] = i % 2 ? 0 : kCount - 1;
  }
  for (const Words& keys : {rising, falling, few, sparse}) check(GetParam(), keys, kCount);
}

TEST_P(BothSorts, IsStableForEqualKeys) { check(GetParam(), Words(100000, 77), 1000); }

TEST_P(BothSorts, SortsBinsAroundTheBinLimit) {
  // Neighboring bins of limit - 1, limit, limit + 1 and several chunks, their keys spread over all indices.
  Words keys;
  const uint32_t sizes[] = {kBinLimit - 1, kBinLimit, kBinLimit + 1, kChunkIndices + 1, 3, kBinLimit + 100, 1};
  for (uint32_t bin = 0; bin < std::size(sizes); ++bin) keys.insert(keys.end(), sizes[bin], bin);
  std::mt19937 random(5);
  std::ranges::shuffle(keys, random);
  check(GetParam(), keys, 9);
  std::ranges::sort(keys, std::greater());
  check(GetParam(), keys, 9);
}

TEST_P(BothSorts, IsDeterministic) {
  const Words keys = randomKeys(50000, 40);
  const KeySortDesc desc{50000, 40, GetParam(), true, true};
  EXPECT_TRUE(sorted(desc, keys) == sorted(desc, keys));
}

TEST_P(BothSorts, ReturnsOrderOnly) {
  const Words keys = randomKeys(3000, 500);
  const Sorted got = sorted({3000, 500, GetParam()}, keys);
  EXPECT_TRUE(got.order == expected(keys, 500, false).order);
}

// The caller's passes count the keys and compute the final slots (KeySortDesc::fusedEnds).
TEST_P(BothSorts, SortsWithCallerProvidedPasses) {
  struct Push {
    uint32_t count;
  };
  Words large(3000, 5);
  for (uint32_t i = 0; i < large.size(); ++i)
    if (i % 3 == 0) large[i] = i % 40;
  for (const Words& keys : {randomKeys(20000, 4000), randomKeys(100, 9), large}) {
    const auto count = static_cast<uint32_t>(keys.size());
    auto sort = KeySort::create(device(), {.count = count, .keyRange = 4000, .method = GetParam(), .start = true, .fusedEnds = true});
    ASSERT_TRUE(sort) << sort.error().message;
    const bool counts = GetParam() == SortMethod::Counting;
    const BindingKind buffers[5] = {};
    const uint32_t constants[] = {sort->listsOversized()};
    const char* shader = counts ? "sort_keys_counted" : "sort_keys";
    const auto make = computePipeline(device(), {.shader = shader,
                                                 .spirv = testShader(shader),
                                                 .bindings = std::span(buffers).first(counts ? 5 : 2),
                                                 .pushConstantBytes = sizeof(Push),
                                                 .constants = std::span(constants).first(counts ? 1 : 0)});
    const auto move = computePipeline(
        device(), {.shader = "sort_moved", .spirv = testShader("sort_moved"), .bindings = buffers, .pushConstantBytes = sizeof(Push)});
    ASSERT_TRUE(make && move);
    const WordBuffer source = words(keys), start = words(4001), moved = words(count, ~0u);
    runGraph([&](Graph& graph) {
      const BufferRef from = source.in(graph, "source");
      const SortTargets targets{.order = {}, .start = start.in(graph, "start"), .keys = {}};
      KeyCounters counters = sort->begin(graph, targets);
      EXPECT_EQ(counters.counts(), counts);
      BufferRef made = graph.create("keys", {4 * uint64_t{count}});
      graph.pass("make keys", [&](Pass& pass) {
        pass.read(from, Use::ComputeRead);
        made = pass.write(made, Use::ComputeWrite, true);
        if (counters.counts())
          for (BufferRef* ref : {&counters.start, &counters.rank, &counters.oversized}) *ref = pass.write(*ref, Use::ComputeWrite);
        const Kernel kernel = counters.counts() ? pass.kernel(*make, {from, made, counters.start, counters.rank, counters.oversized})
                                                : pass.kernel(*make, {from, made});
        return [kernel, count](Commands& commands) { commands.dispatch(kernel, divideUp(count, 64), Push{count}); };
      });
      const SortedKeys sorted = sort->finish(graph, made, counters, targets);
      BufferRef to = moved.in(graph, "moved");
      graph.pass("move", [&](Pass& pass) {
        for (BufferRef ref : {made, sorted.start, sorted.arrived, sorted.order}) pass.read(ref, Use::ComputeRead);
        to = pass.write(to, Use::ComputeWrite, true);
        const Kernel kernel = pass.kernel(*move, {made, sorted.start, sorted.arrived, sorted.order, to});
        return [kernel, count](Commands& commands) { commands.dispatch(kernel, divideUp(count, 64), Push{count}); };
      });
    });
    const Sorted wanted = expected(keys, 4000, true);
    EXPECT_TRUE(moved.copy() == wanted.order) << count;
    EXPECT_TRUE(start.copy() == wanted.start) << count;
  }
}

TEST_P(BothSorts, DeclaresNothingForZeroKeys) {
  auto sort = KeySort::create(device(), {0, 1000, GetParam(), true, true});
  ASSERT_TRUE(sort) << sort.error().message;
  EXPECT_TRUE(sort->dispatches().empty());
  Graph graph;
  const BufferRef order = graph.create("order", {4});
  EXPECT_EQ(sort->addTo(graph, BufferRef{}, {.order = order}).order, order);
  ASSERT_TRUE(graph.compile());
  EXPECT_TRUE(graph.report().empty());
}

TEST_P(BothSorts, RunsSeveralSortsInOneCommandBuffer) {
  // Two sorts of one object and one of another, one fed with the other's result, over three frames: all in one command buffer.
  const Words a = randomKeys(5000, 3000), b = randomKeys(5000, 3000), c = randomKeys(700, 50);
  auto large = KeySort::create(device(), {5000, 3000, GetParam(), true, true});
  auto small = KeySort::create(device(), {700, 50, GetParam(), false, true});
  ASSERT_TRUE(large && small);
  const WordBuffer keysA = words(a), keysB = words(b), keysC = words(c);
  const WordBuffer startA = words(3001), again = words(5000), orderB = words(5000), orderC = words(700);
  const auto frame = [&](Graph& graph) {
    const SortedKeys first = large->addTo(graph, keysA.in(graph, "a"), {.start = startA.in(graph, "start a")});
    large->addTo(graph, first.keys, {.order = again.in(graph, "again")});
    large->addTo(graph, keysB.in(graph, "b"), {.order = orderB.in(graph, "order b")});
    small->addTo(graph, keysC.in(graph, "c"), {.order = orderC.in(graph, "order c")});
  };
  runGraphs({frame, frame, frame});
  EXPECT_TRUE(startA.copy() == expected(a, 3000, true).start);
  Words identity(5000);
  for (uint32_t i = 0; i < 5000; ++i) identity[i] = i;
  EXPECT_TRUE(again.copy() == identity);
  EXPECT_TRUE(orderB.copy() == expected(b, 3000, false).order);
  EXPECT_TRUE(orderC.copy() == expected(c, 50, false).order);
}

TEST_P(BothSorts, GateSkipsAllDispatches) {
  // 5,000 equal keys: the dispatch for oversized bins must be skipped as well.
  for (const Words& keys : {randomKeys(5000, 3000), Words(5000, 2)}) {
    auto sort = KeySort::create(device(), {5000, 3000, GetParam(), true, true});
    ASSERT_TRUE(sort);
    Words open{9, 9, 9}, closed{9, 9, 9};  // an unrelated command before those of the sort
    for (const auto& dispatch : sort->dispatches())
      for (uint32_t n : dispatch.groups) {
        open.push_back(n);
        closed.push_back(0);
      }
    const WordBuffer input = words(keys), other = words(randomKeys(5000, 100));
    const WordBuffer order = words(5000, 1), start = words(3001, 2), sortedKeys = words(5000, 3);
    const WordBuffer openGate = words(open), closedGate = words(closed);
    const auto frame = [&](const WordBuffer& from, const WordBuffer& arguments) {
      return [&](Graph& graph) {
        const Gate gate{arguments.in(graph, "gate"), 1};
        sort->addTo(graph, from.in(graph, "keys"),
                    {order.in(graph, "order"), start.in(graph, "start"), sortedKeys.in(graph, "sorted keys")}, &gate);
      };
    };
    runGraph(frame(input, closedGate));
    EXPECT_TRUE(order.copy() == Words(5000, 1));
    EXPECT_TRUE(start.copy() == Words(3001, 2));
    EXPECT_TRUE(sortedKeys.copy() == Words(5000, 3));
    runGraphs({frame(input, openGate), frame(other, closedGate)});
    EXPECT_TRUE((Sorted{order.copy(), start.copy(), sortedKeys.copy()}) == expected(keys, 3000, true));
  }
}

TEST_F(KeySortTest, RadixSortsFullRangeKeys) {
  for (uint64_t keyRange : {kAllBits, kAllBits - 1, kAllBits / 2 + 1, uint64_t{1} << 25})
    for (uint32_t count : {1u, 2u, 4097u, 65537u}) check(SortMethod::Radix, randomKeys(count, keyRange), keyRange);
  check(SortMethod::Radix, {~0u, 0, ~0u, 1u << 31, (1u << 31) - 1, 0}, kAllBits);
}

TEST_F(KeySortTest, CountingClampsOutOfRangeKeys) {
  // The key is clamped to the largest one; nothing is written out of bounds, and the others are sorted.
  const Words got = sorted({4, 10, SortMethod::Counting, true}, Words{3, ~0u, 9, 0}).order;
  EXPECT_EQ(got, (Words{3, 0, 1, 2}));
}

TEST_F(KeySortTest, SortsMillions) {
  constexpr uint32_t kCount = 4u << 20;
  for (const SortMethod method : {SortMethod::Counting, SortMethod::Radix}) check(method, randomKeys(kCount, kCount / 4), kCount / 4);
}

TEST_F(KeySortTest, ChoosesMethodByKeyDensity) {
  EXPECT_EQ(chooseSortMethod({100000, 100000}), SortMethod::Counting);
  EXPECT_EQ(chooseSortMethod({100000, 20000}), SortMethod::Counting);
  EXPECT_EQ(chooseSortMethod({100000, 64}), SortMethod::Radix);
  EXPECT_EQ(chooseSortMethod({100000, 1000000}), SortMethod::Radix);
  EXPECT_EQ(chooseSortMethod({.count = 100000, .keyRange = 1000000, .start = true}), SortMethod::Counting);
  EXPECT_EQ(chooseSortMethod({KeySortDesc::kMaxCount, kAllBits}), SortMethod::Radix);
  EXPECT_EQ(chooseSortMethod({100, 100, SortMethod::Radix}), SortMethod::Radix);
  auto sort = KeySort::create(device(), {1000, 1000});
  ASSERT_TRUE(sort);
  EXPECT_EQ(sort->method(), SortMethod::Counting);
  const Words keys = randomKeys(1000, 1000);
  EXPECT_TRUE(sorted({1000, 1000}, keys).order == expected(keys, 1000, false).order);
}

TEST_F(KeySortTest, RejectsCountsAndRangesOutOfBounds) {
  const auto refusal = [this](const KeySortDesc& desc) {
    auto sort = KeySort::create(device(), desc);
    EXPECT_FALSE(sort);
    return sort ? std::string() : sort.error().message;
  };
  EXPECT_EQ(refusal({KeySortDesc::kMaxCount + 1, 10}), "sort: 67108865 keys; expected at most 67108864");
  EXPECT_EQ(refusal({10, 0}), "sort: key range 0; expected 1 to 2^32");
  EXPECT_EQ(refusal({10, kAllBits + 1}), "sort: key range 4294967297; expected 1 to 2^32");
  const std::string tooLarge =
      "sort: a start table of 4294967296 keys; expected at most " + std::to_string(maxStartRange(device())) + " on " + device().info().name;
  EXPECT_EQ(refusal({10, kAllBits, SortMethod::Counting}), tooLarge);
  EXPECT_EQ(refusal({10, kAllBits, SortMethod::Radix, true}), tooLarge);
}

TEST(Dispatches, FoldsLargeDispatches) {
  for (uint64_t groups : {uint64_t{1}, uint64_t{65535}, uint64_t{65536}, uint64_t{131071}, uint64_t{1} << 25}) {
    const GroupCount folded = foldGroups(groups);
    EXPECT_LE(folded[0], 65535u);
    EXPECT_LE(folded[1], 65535u);
    EXPECT_GE(uint64_t{folded[0]} * folded[1], groups);
    EXPECT_LT(uint64_t{folded[0]} * (folded[1] - 1), groups);
  }
  EXPECT_EQ(foldGroups(0), (GroupCount{0, 0, 0}));
}

}  // namespace
}  // namespace rill::test
