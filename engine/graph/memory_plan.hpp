#pragma once
// Where transients lie: those whose lifetimes do not meet share memory. Knows no graph and no Vulkan.
#include <cstdint>
#include <span>
#include <vector>

namespace rill {

/// Vulkan allows no device to ask for more than 256 for storage, uniform and texel buffers alike.
inline constexpr uint64_t kTransientAlignment = 256;

struct Placement {
  uint32_t first = 0, last = 0;  ///< passes that use it, both included
  uint64_t size = 0;
  uint64_t alignment = kTransientAlignment;
  uint32_t heap = 0;    ///< out
  uint64_t offset = 0;  ///< out
};

class MemoryPlanner {
 public:
  /// First fit in order of first use; `heaps` gets the size of each. No heap exceeds `limit`, and no placement may.
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
