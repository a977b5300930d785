#pragma once
// Exclusive prefix sum, as graph passes.
#include <cstdint>
#include <string_view>
#include <vector>

#include "gpu/resources.hpp"
#include "rill/expected.hpp"
#include "rill/graph.hpp"
#include "sort/dispatches.hpp"

namespace rill {

/// Names of a scan's passes; string literals.
struct ScanNames {
  std::string_view single = "sort/scan", reduce = "sort/scan reduce", tiles = "sort/scan tiles", apply = "sort/scan apply";
};

/// Replaces values[k] by the sum of values[0 .. k-1] modulo 2^32, in place. Reduce-then-scan: no workgroup
/// waits for another.
class Scan {
 public:
  static constexpr uint32_t kMaxCount = 1u << 29;

  /// `count`: 0 .. kMaxCount values, otherwise BadInput. The pipelines are the same for every count, once 1
  /// or more.
  /// `storageReads`: read through storage buffers instead of texel buffers; same result.
  static Expected<Scan> create(Device& device, uint32_t count, bool storageReads = false, const ScanNames& names = {});

  uint32_t count() const { return count_; }
  /// The group counts of its dispatches, in order.
  std::vector<GroupCount> groups() const;
  /// Declares the passes and returns the scanned version of `values` (paddedWords(count) uints; the padding
  /// is undefined afterwards). With a count of 0 nothing is declared.
  BufferRef addTo(Graph& graph, BufferRef values, const Gate* gate = nullptr) const;

 private:
  uint32_t count_ = 0;
  ScanNames names_;
  struct Pipelines {
    const ComputePipeline *single = nullptr, *reduce = nullptr, *apply = nullptr, *applyScanned = nullptr;
  };
  Pipelines pipelines_;
};

}  // namespace rill
