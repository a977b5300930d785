#pragma once
// Counting sort: count keys, scan the counts, scatter, then sort each bin by original index.
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "sort/dispatches.hpp"
#include "sort/key_sort_types.hpp"
#include "sort/scan.hpp"
#include "sort/sort_types.h"

namespace rill {

/// Atomics assign slots within a bin in nondeterministic order; the last step restores stable order. Up to
/// kBinLimit it compares an index with all of its bin; larger bins use a bit mask per chunk of indices.
class CountingSort {
 public:
  /// KeySort::create has validated `desc`.
  static Expected<CountingSort> create(Device& device, const KeySortDesc& desc);

  std::vector<GatedDispatch> dispatches() const;
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
  const ComputePipeline* clear_ = nullptr;
  const ComputePipeline* count_ = nullptr;
  const ComputePipeline* scatter_ = nullptr;
  const ComputePipeline* orderBins_ = nullptr;
  const ComputePipeline* orderOversized_ = nullptr;
};

}  // namespace rill
