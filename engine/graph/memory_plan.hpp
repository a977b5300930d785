#pragma once
// Placement of transients: those with disjoint lifetimes may share memory. Independent of the graph and of Vulkan.
#include <cstdint>
#include <span>
#include <vector>

namespace rill {

/// Upper limit that Vulkan sets for the storage, uniform and texel buffer offset alignments, in bytes.
inline constexpr uint64_t kTransientAlignment = 256;

struct Placement {
  uint32_t first = 0, last = 0;  ///< first and last pass that uses it (inclusive)
  uint64_t size = 0;
  uint64_t alignment = kTransientAlignment;
  uint32_t heap = 0;    ///< out
  uint64_t offset = 0;  ///< out
};

class MemoryPlanner {
 public:
  /// First fit in order of first use; returns the heap sizes in `heaps`. No heap exceeds `limit` bytes; each
  /// placement must be 1 .. `limit` bytes large.
  void plan(std::span<Placement> placements, uint64_t limit, std::vector<uint64_t>& heaps);

 private:
  struct Taken {
    uint32_t heap;
    uint64_t begin, end;
  };
  std::vector<uint32_t> order_;
  std::vector<Taken> taken_;
};

inline bool sharesMemory(const Placement& a, const Placement& b) {
  return a.heap == b.heap && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
}

inline bool covers(const Placement& a, const Placement& b) {
  return a.heap == b.heap && a.offset <= b.offset && b.offset + b.size <= a.offset + a.size;
}

}  // namespace rill
