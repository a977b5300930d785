#pragma once
// What is asked of a sort and what comes out of it.
#include <cstdint>

#include "rill/graph.hpp"

namespace rill {

enum class SortMethod : uint8_t {
  Auto,      ///< by chooseSortMethod()
  Counting,  ///< a counter a key value: time and memory rise with the key range
  Radix      ///< six bits a pass: time rises with the bits of a key
};

struct KeySortDesc {
  static constexpr uint32_t kMaxCount = 4u << 20;
  static constexpr uint64_t kMaxKeyRange = uint64_t{1} << 32;
  /// Largest key range that has a `start` table, and so of the counting sort: its keyRange + 1 entries fit in 128 MiB.
  static constexpr uint64_t kMaxStartRange = (128u << 20) / sizeof(uint32_t) - 1;

  uint32_t count = 0;     ///< keys, 0 .. kMaxCount
  uint64_t keyRange = 0;  ///< keys are below it; 1 .. kMaxKeyRange
  SortMethod method = SortMethod::Auto;
  bool start = false;         ///< whether SortedKeys::start is made; keyRange at most kMaxStartRange
  bool keys = false;          ///< whether SortedKeys::keys is made
  bool storageReads = false;  ///< through storage buffers even where texel buffers would do; the same result
  /// The ends are the caller's: its pass that makes the keys counts them (shaders/sort/count.glsl), and its pass that moves what is
  /// sorted finds the places (shaders/sort/place.glsl). Neither is a pass of the sort's then. Without `keys`.
  bool openEnds = false;
};

/// Where the results go. A ref left out is made as a transient where the result is asked for: behind a gate, give the
/// buffers that must outlive the frames in which the gate is closed.
struct SortTargets {
  BufferRef order;  ///< count uints
  BufferRef start;  ///< paddedWords(keyRange + 1) uints
  BufferRef keys;   ///< count uints
};

struct SortedKeys {
  BufferRef order;  ///< order[slot] = index before the sort; equal keys stay in the order they were in
  BufferRef start;  ///< start[k] = first slot of key k, start[keyRange] = count; where asked for
  BufferRef keys;   ///< keys[slot], ascending; where asked for
  /// arrived[slot] = index before the sort, equal keys in any order; of a sort with open ends. Its `order` holds bins above kBinLimit
  /// alone.
  BufferRef arrived;
};

/// What the pass counts into that makes the keys of a sort with open ends.
struct KeyCounters {
  BufferRef start, rank, oversized;
  bool counts() const { return !(rank == BufferRef{}); }  ///< a radix sort has no counters
};

}  // namespace rill
