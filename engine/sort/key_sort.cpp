#include "sort/key_sort.hpp"

#include <string>
#include <utility>

namespace rill {
namespace {

Error badInput(std::string message) { return {ErrorKind::BadInput, "sort: " + std::move(message)}; }

Expected<void> judge(const KeySortDesc& desc) {
  if (desc.count > KeySortDesc::kMaxCount)
    return badInput(std::to_string(desc.count) + " keys, at most " + std::to_string(KeySortDesc::kMaxCount) + " are possible");
  if (desc.keyRange < 1 || desc.keyRange > KeySortDesc::kMaxKeyRange)
    return badInput("a key range of " + std::to_string(desc.keyRange) + ", expected 1 to 2^32");
  const bool table = desc.start || desc.method == SortMethod::Counting;
  if (table && desc.keyRange > KeySortDesc::kMaxStartRange)
    return badInput("a table of " + std::to_string(desc.keyRange) + " keys, at most " + std::to_string(KeySortDesc::kMaxStartRange) +
                    " fit in 128 MiB");
  return {};
}

}  // namespace

SortMethod chooseSortMethod(uint32_t count, uint64_t keyRange) {
  // A radix sort makes one pass over few distinct keys, where a counting sort would have bins too large to order quickly;
  // and it needs no counters where keys are sparse.
  constexpr uint64_t kMostKeysABin = 64;
  constexpr uint64_t kMostCountersAKey = 8;
  if (keyRange > KeySortDesc::kMaxStartRange) return SortMethod::Radix;
  const bool dense = keyRange <= kMostCountersAKey * count;
  const bool smallBins = count <= kMostKeysABin * keyRange;
  return dense && smallBins ? SortMethod::Counting : SortMethod::Radix;
}

Expected<KeySort> KeySort::create(Device& device, const KeySortDesc& desc) {
  if (auto fine = judge(desc); !fine) return fine.error();
  const SortMethod method = desc.method == SortMethod::Auto ? chooseSortMethod(desc.count, desc.keyRange) : desc.method;
  if (method == SortMethod::Counting) {
    auto sort = CountingSort::create(device, desc);
    if (!sort) return sort.error();
    return KeySort(*std::move(sort));
  }
  auto sort = RadixSort::create(device, desc);
  if (!sort) return sort.error();
  return KeySort(*std::move(sort));
}

SortMethod KeySort::method() const { return std::holds_alternative<CountingSort>(sort_) ? SortMethod::Counting : SortMethod::Radix; }

std::vector<GroupCount> KeySort::groups() const {
  return std::visit([](const auto& sort) { return sort.groups(); }, sort_);
}

SortedKeys KeySort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  return std::visit([&](const auto& sort) { return sort.addTo(graph, keys, targets, gate); }, sort_);
}

}  // namespace rill
