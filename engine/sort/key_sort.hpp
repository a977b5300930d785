#pragma once
// Sorts integer keys on the device as graph passes: counting sort for dense keys, radix sort for sparse keys.
#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/graph.hpp"
#include "sort/counting_sort.hpp"
#include "sort/dispatches.hpp"
#include "sort/key_sort_types.hpp"
#include "sort/radix_sort.hpp"
#include "sort/sort_types.h"

namespace rill {

/// A stable sort of keys on the device. The result is deterministic.
///
///     auto sort = KeySort::create(device, {.count = n, .keyRange = cells, .start = true});
///     const SortedKeys sorted = sort->addTo(graph, keys);
class KeySort {
 public:
  /// Fails with BadInput if the count or the key range is out of bounds.
  static Expected<KeySort> create(Device& device, const KeySortDesc& desc);

  /// The chosen method, Counting or Radix.
  SortMethod method() const;
  /// Its dispatches, in order: their group counts are the contents of the Gate's arguments if the sort runs. With fusedEnds
  /// fewer keys than desc.count may be sorted: the others are kNoKey, and have the largest indices.
  std::vector<GatedDispatch> dispatches() const;

  /// Declares the passes. `keys` holds desc.count uints below desc.keyRange; larger ones only affect the
  /// result. If the gate's arguments are zero the targets keep their content. With a count of 0 nothing is
  /// declared and the targets are returned.
  SortedKeys addTo(Graph& graph, BufferRef keys, const SortTargets& targets = {}, const Gate* gate = nullptr) const;

  /// LIST_OVERSIZED of a shader that includes shaders/sort/count.glsl.
  bool listsOversized() const { return desc_.count > kBinLimit; }
  /// With desc.fusedEnds: call begin(), declare the pass that writes keys and counters, then call finish().
  KeyCounters begin(Graph& graph, const SortTargets& targets = {}, const Gate* gate = nullptr) const;
  SortedKeys finish(Graph& graph, BufferRef keys, const KeyCounters& counters, const SortTargets& targets = {},
                    const Gate* gate = nullptr) const;

 private:
  KeySort(std::variant<CountingSort, RadixSort> sort, const KeySortDesc& desc) : desc_(desc), sort_(std::move(sort)) {}
  KeySortDesc desc_;
  std::variant<CountingSort, RadixSort> sort_;
};

/// desc.method, or the method that Auto selects for this description.
SortMethod chooseSortMethod(const KeySortDesc& desc);

/// The largest key range with a `start` table: keyRange + 1 entries fit into a buffer of the device.
uint64_t maxStartRange(const Device& device);

}  // namespace rill
