#include "sort/key_sort.hpp"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "sort/sort_types.h"

namespace rill {
namespace {

Error badInput(std::string message) { return {ErrorKind::BadInput, "sort: " + std::move(message)}; }

Expected<void> validate(const Device& device, const KeySortDesc& desc) {
  if (desc.count > KeySortDesc::kMaxCount)
    return badInput(std::to_string(desc.count) + " keys; expected at most " + std::to_string(KeySortDesc::kMaxCount));
  if (desc.keyRange < 1 || desc.keyRange > KeySortDesc::kMaxKeyRange)
    return badInput("key range " + std::to_string(desc.keyRange) + "; expected 1 to 2^32");
  if (desc.keys && desc.fusedEnds) return badInput("fusedEnds and keys are both set; expected at most one");
  const bool table = desc.start || desc.method == SortMethod::Counting;
  if (table && desc.keyRange > maxStartRange(device))
    return badInput("a start table of " + std::to_string(desc.keyRange) + " keys; expected at most " +
                    std::to_string(maxStartRange(device)) + " on " + device.info().name);
  return {};
}

}  // namespace

uint64_t maxStartRange(const Device& device) {
  const uint64_t entries = device.info().maxBufferBytes / sizeof(uint32_t) / 4 * 4;  // see paddedWords()
  return std::min<uint64_t>(KeySortDesc::kMaxStartRange, entries - 1);
}

SortMethod chooseSortMethod(const KeySortDesc& desc) {
  if (desc.method != SortMethod::Auto) return desc.method;
  if (desc.keyRange > KeySortDesc::kMaxStartRange) return SortMethod::Radix;
  // Counting is slow for large bins (ordering them) and for sparse keys (clearing and scanning counters).
  // Thresholds measured on lavapipe: docs/notes/sorting.md.
  constexpr uint64_t kMaxKeysPerValue = 16;
  constexpr uint64_t kMaxValuesPerKey = 6;
  const bool smallBins = desc.count <= kMaxKeysPerValue * desc.keyRange;
  const bool dense = desc.start || desc.keyRange <= kMaxValuesPerKey * desc.count;
  return smallBins && dense ? SortMethod::Counting : SortMethod::Radix;
}

Expected<KeySort> KeySort::create(Device& device, const KeySortDesc& desc) {
  if (auto valid = validate(device, desc); !valid) return valid.error();
  if (chooseSortMethod(desc) == SortMethod::Counting && desc.keyRange <= maxStartRange(device)) {
    auto sort = CountingSort::create(device, desc);
    if (!sort) return sort.error();
    return KeySort(*std::move(sort), desc);
  }
  auto sort = RadixSort::create(device, desc);
  if (!sort) return sort.error();
  return KeySort(*std::move(sort), desc);
}

SortMethod KeySort::method() const { return std::holds_alternative<CountingSort>(sort_) ? SortMethod::Counting : SortMethod::Radix; }

std::vector<GatedDispatch> KeySort::dispatches() const {
  return std::visit([](const auto& sort) { return sort.dispatches(); }, sort_);
}

SortedKeys KeySort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  assert(!desc_.fusedEnds);
  return std::visit([&](const auto& sort) { return sort.addTo(graph, keys, targets, gate); }, sort_);
}

KeyCounters KeySort::begin(Graph& graph, const SortTargets& targets, const Gate* gate) const {
  assert(desc_.fusedEnds);
  const auto* counting = std::get_if<CountingSort>(&sort_);
  return counting ? counting->begin(graph, targets, gate) : KeyCounters{};
}

SortedKeys KeySort::finish(Graph& graph, BufferRef keys, const KeyCounters& counters, const SortTargets& targets, const Gate* gate) const {
  assert(desc_.fusedEnds);
  if (const auto* counting = std::get_if<CountingSort>(&sort_)) return counting->finish(graph, keys, counters, targets, gate);
  SortedKeys sorted = std::get<RadixSort>(sort_).addTo(graph, keys, targets, gate);
  sorted.arrived = sorted.order;  // sorted order is also a valid order of arrival
  return sorted;
}

}  // namespace rill
