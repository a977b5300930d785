#include "sort/key_sort.hpp"

#include <cassert>
#include <string>
#include <utility>

#include "sort/sort_types.h"

namespace rill {
namespace {

Error badInput(std::string message) { return {ErrorKind::BadInput, "sort: " + std::move(message)}; }

Expected<void> judge(const KeySortDesc& desc) {
  if (desc.count > KeySortDesc::kMaxCount)
    return badInput(std::to_string(desc.count) + " keys, at most " + std::to_string(KeySortDesc::kMaxCount) + " are possible");
  if (desc.keyRange < 1 || desc.keyRange > KeySortDesc::kMaxKeyRange)
    return badInput("a key range of " + std::to_string(desc.keyRange) + ", expected 1 to 2^32");
  if (desc.keys && desc.openEnds) return badInput("open ends and sorted keys were asked for; expected one of them");
  const bool table = desc.start || desc.method == SortMethod::Counting;
  if (table && desc.keyRange > KeySortDesc::kMaxStartRange)
    return badInput("a table of " + std::to_string(desc.keyRange) + " keys, at most " + std::to_string(KeySortDesc::kMaxStartRange) +
                    " fit in 128 MiB");
  return {};
}

}  // namespace

SortMethod chooseSortMethod(const KeySortDesc& desc) {
  if (desc.method != SortMethod::Auto) return desc.method;
  if (desc.keyRange > KeySortDesc::kMaxStartRange) return SortMethod::Radix;
  // CPU milliseconds over two cores on lavapipe, 100,000 random keys, counting against radix by the keys a key value has in the mean:
  // 256: 29 / 3.2, 64: 7.9 / 5.1, 16: 4.1 / 4.6, 4: 2.7 / 4.4, 1: 3.1 / 6.5, 1/4: 5.4 / 7.1, 1/8: 10 / 7.1, 1/16: 14 / 6.5.
  // Large bins take long to order, and radix has few digits then; sparse keys leave many counters to clear and to scan.
  // A table of starts costs both methods a time that rises with the key range, radix more: 1/16: 17 / 46.
  // Counting has become a third cheaper since (clearing and scanning most), which moves no choice that the fluid makes.
  constexpr uint64_t kMaxKeysAValue = 16;
  constexpr uint64_t kMaxValuesAKey = 6;
  const bool smallBins = desc.count <= kMaxKeysAValue * desc.keyRange;
  const bool dense = desc.start || desc.keyRange <= kMaxValuesAKey * desc.count;
  return smallBins && dense ? SortMethod::Counting : SortMethod::Radix;
}

Expected<KeySort> KeySort::create(Device& device, const KeySortDesc& desc) {
  if (auto fine = judge(desc); !fine) return fine.error();
  if (chooseSortMethod(desc) == SortMethod::Counting) {
    auto sort = CountingSort::create(device, desc);
    if (!sort) return sort.error();
    return KeySort(*std::move(sort), desc);
  }
  auto sort = RadixSort::create(device, desc);
  if (!sort) return sort.error();
  return KeySort(*std::move(sort), desc);
}

SortMethod KeySort::method() const { return std::holds_alternative<CountingSort>(sort_) ? SortMethod::Counting : SortMethod::Radix; }

std::vector<GroupCount> KeySort::groups() const {
  return std::visit([](const auto& sort) { return sort.groups(); }, sort_);
}

std::array<uint32_t, 2> KeySort::counterConstants() const { return {desc_.count > kBinLimit, method() == SortMethod::Counting}; }

SortedKeys KeySort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  assert(!desc_.openEnds);
  return std::visit([&](const auto& sort) { return sort.addTo(graph, keys, targets, gate); }, sort_);
}

KeyCounters KeySort::begin(Graph& graph, const SortTargets& targets, const Gate* gate) const {
  assert(desc_.openEnds);
  const auto* counting = std::get_if<CountingSort>(&sort_);
  return counting ? counting->begin(graph, targets, gate) : KeyCounters{};
}

SortedKeys KeySort::finish(Graph& graph, BufferRef keys, const KeyCounters& counters, const SortTargets& targets, const Gate* gate) const {
  assert(desc_.openEnds);
  if (const auto* counting = std::get_if<CountingSort>(&sort_)) return counting->finish(graph, keys, counters, targets, gate);
  SortedKeys sorted = std::get<RadixSort>(sort_).addTo(graph, keys, targets, gate);
  sorted.arrived = sorted.order;  // in order, too
  return sorted;
}

}  // namespace rill
