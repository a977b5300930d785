#pragma once
// Sorts integer keys on the device, as graph passes: a counting sort where keys are dense, a radix sort where they are not.
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

namespace rill {

/// A stable sort of keys that are on the device. Its result is the same whatever the order in which the device runs things.
///
///     auto sort = KeySort::create(device, {.count = n, .keyRange = cells, .start = true});
///     const SortedKeys sorted = sort->addTo(graph, keys);
class KeySort {
 public:
  /// BadInput, saying what was asked for and what is possible, for a count or a key range out of bounds.
  static Expected<KeySort> create(Device& device, const KeySortDesc& desc);

  /// Counting or Radix: what Auto chose.
  SortMethod method() const;
  /// The group counts of its dispatches, in order: what belongs behind a Gate for the sort to run.
  std::vector<GroupCount> groups() const;

  /// Declares the passes. `keys` holds desc.count uints, each below desc.keyRange (a larger one harms nothing but the result).
  /// Where the gate's arguments are zero the targets keep their content. No keys: nothing is declared, the targets are returned.
  SortedKeys addTo(Graph& graph, BufferRef keys, const SortTargets& targets = {}, const Gate* gate = nullptr) const;

  /// Of a shader that includes shaders/sort/count.glsl.
  std::array<uint32_t, 2> counterConstants() const;
  /// The same for desc.openEnds: begin(), the caller's pass that makes the keys and writes the counters, finish().
  KeyCounters begin(Graph& graph, const SortTargets& targets = {}, const Gate* gate = nullptr) const;
  SortedKeys finish(Graph& graph, BufferRef keys, const KeyCounters& counters, const SortTargets& targets = {},
                    const Gate* gate = nullptr) const;

 private:
  KeySort(std::variant<CountingSort, RadixSort> sort, const KeySortDesc& desc) : desc_(desc), sort_(std::move(sort)) {}
  KeySortDesc desc_;
  std::variant<CountingSort, RadixSort> sort_;
};

/// The method that is taken: desc.method, or the one that Auto stands for.
SortMethod chooseSortMethod(const KeySortDesc& desc);

}  // namespace rill
