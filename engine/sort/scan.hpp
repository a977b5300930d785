#pragma once
// Exclusive prefix sum, as graph passes.
#include <cstdint>
#include <vector>

#include "gpu/resources.hpp"
#include "rill/expected.hpp"
#include "rill/graph.hpp"
#include "sort/dispatches.hpp"

namespace rill {

/// values[k] becomes the sum of values[0 .. k-1], modulo 2^32, in place. Reduce, then scan: no workgroup waits for another.
class Scan {
 public:
  /// Most values: what fits a buffer of 128 MiB.
  static constexpr uint32_t kMaxCount = (128u << 20) / sizeof(uint32_t);

  /// `count` values, 0 .. kMaxCount; BadInput above.
  static Expected<Scan> create(Device& device, uint32_t count);

  uint32_t count() const { return count_; }
  /// The group counts of its dispatches, in order.
  std::vector<GroupCount> groups() const;
  /// Declares the passes and returns the scanned version of `values` (count uints). No values: nothing is declared.
  BufferRef addTo(Graph& graph, BufferRef values, const Gate* gate = nullptr) const;

 private:
  uint32_t count_ = 0;
  const ComputePipeline* single_ = nullptr;
  const ComputePipeline* reduce_ = nullptr;
  const ComputePipeline* apply_ = nullptr;
};

}  // namespace rill
