#pragma once
// LSD radix sort; the number of passes follows from the key range.
#include <array>
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "sort/dispatches.hpp"
#include "sort/key_sort_types.hpp"
#include "sort/scan.hpp"

namespace rill {

/// Each pass counts the digits per tile, scans the counts over digits and tiles, and scatters keys and
/// indices. Reduce-then-scan: no workgroup waits for another, and there are no atomics.
class RadixSort {
 public:
  /// KeySort::create has validated `desc`.
  static Expected<RadixSort> create(Device& device, const KeySortDesc& desc);

  /// Number of passes over the keys, 1 .. 6.
  uint32_t passes() const { return passes_; }
  std::vector<GatedDispatch> dispatches() const;
  SortedKeys addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const;

 private:
  bool writesKeys(uint32_t pass) const;
  uint64_t startGroups() const;

  KeySortDesc desc_;
  uint32_t passes_ = 0;
  uint32_t bits_ = 0;  // per digit
  uint32_t tiles_ = 0;
  Scan scan_;
  const ComputePipeline* count_ = nullptr;
  std::array<const ComputePipeline*, 6> scatter_{};  // per pass
  const ComputePipeline* start_ = nullptr;
};

}  // namespace rill
