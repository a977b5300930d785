#pragma once
// Counting sort: count the keys of each value, scan the counts, scatter, then put each bin into the order of old indices.
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "sort/dispatches.hpp"
#include "sort/key_sort_types.hpp"
#include "sort/scan.hpp"
#include "sort/sort_types.h"

namespace rill {

/// Places inside a bin come from atomics and so in any order; the last step makes them those of a stable sort. It compares an
/// index with all of its bin, up to kBinLimit; a larger bin is ordered by workgroups of its own, through one bit an index.
class CountingSort {
 public:
  /// `desc` has been judged by KeySort::create.
  static Expected<CountingSort> create(Device& device, const KeySortDesc& desc);

  std::vector<GroupCount> groups() const;
  SortedKeys addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const;
  KeyCounters begin(Graph& graph, const SortTargets& targets, const Gate* gate) const;
  SortedKeys finish(Graph& graph, BufferRef keys, const KeyCounters& counters, const SortTargets& targets, const Gate* gate) const;

 private:
  bool binsMayBeOversized() const;
  uint32_t chunks() const;
  uint64_t clearGroups() const;
  uint64_t countGroups() const;
  uint32_t binGroups() const;
  CountingPush push() const;
  uint64_t oversizedGroups() const;

  KeySortDesc desc_;
  Scan scan_;
  bool texels_ = false;
  const ComputePipeline* clear_ = nullptr;
  const ComputePipeline* count_ = nullptr;
  const ComputePipeline* scatter_ = nullptr;
  const ComputePipeline* orderBins_ = nullptr;
  const ComputePipeline* orderOversized_ = nullptr;
};

}  // namespace rill
