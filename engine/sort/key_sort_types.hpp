#pragma once
// Parameters and results of KeySort.
#include <cstdint>

#include "rill/graph.hpp"

namespace rill {

enum class SortMethod : uint8_t {
  Auto,      ///< chosen by chooseSortMethod()
  Counting,  ///< one counter per key value: time and memory grow with the key range
  Radix      ///< six bits per pass: time grows with the number of key bits
};

struct KeySortDesc {
  static constexpr uint32_t kMaxCount = 1u << 26;  ///< as many as a fluid has particles
  static constexpr uint64_t kMaxKeyRange = uint64_t{1} << 32;
  /// Largest key range with a `start` table, which the counting sort needs; see also maxStartRange().
  static constexpr uint64_t kMaxStartRange = (1u << 29) - 1;

  uint32_t count = 0;     ///< number of keys, 0 .. kMaxCount
  uint64_t keyRange = 0;  ///< exclusive upper bound of the keys, 1 .. kMaxKeyRange
  SortMethod method = SortMethod::Auto;
  bool start = false;         ///< produce SortedKeys::start; keyRange must be at most maxStartRange()
  bool keys = false;          ///< produce SortedKeys::keys
  bool storageReads = false;  ///< read through storage buffers instead of texel buffers; same result
  /// The caller fuses the first and last step into its own passes: the pass that writes the keys also counts
  /// them (shaders/sort/count.glsl), and the pass that reorders the data computes the final slots
  /// (shaders/sort/place.glsl). Not with `keys`.
  bool fusedEnds = false;
};

/// Output buffers. For an empty ref a transient is created if the result is requested. With a gate, pass
/// imported buffers for results that must persist while the sort is skipped.
struct SortTargets {
  BufferRef order;  ///< count uints
  BufferRef start;  ///< paddedWords(keyRange + 1) uints
  BufferRef keys;   ///< count uints
};

struct SortedKeys {
  BufferRef order;  ///< order[slot] = index before the sort; equal keys keep their order
  BufferRef start;  ///< start[k] = first slot of key k, start[keyRange] = count; if requested
  BufferRef keys;   ///< keys[slot], ascending; if requested
  /// With fusedEnds: arrived[slot] = index before the sort, equal keys in any order. `order` then holds only
  /// bins above kBinLimit.
  BufferRef arrived;
};

/// Counters for the caller's key pass of a sort with fusedEnds.
struct KeyCounters {
  BufferRef start, rank, oversized;
  bool counts() const { return !(rank == BufferRef{}); }  ///< a radix sort has no counters
};

}  // namespace rill
