#pragma once
// Runs graphs on host-visible buffers.
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/resources.hpp"
#include "rill/graph.hpp"
#include "sort/key_sort.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {

using Words = std::vector<uint32_t>;

/// The results of a stable sort.
struct Sorted {
  Words order, start, keys;
  friend bool operator==(const Sorted&, const Sorted&) = default;
};

/// A host-visible buffer of words.
class WordBuffer {
 public:
  WordBuffer(Device& device, size_t count, uint32_t filling = 0);
  WordBuffer(Device& device, std::span<const uint32_t> words);

  BufferRef in(Graph& graph, std::string_view name) const;  ///< imported, readable by the host afterwards
  std::span<uint32_t> words() const { return {reinterpret_cast<uint32_t*>(buffer_.mapped()), count_}; }
  Words copy() const { return {words().begin(), words().end()}; }

 private:
  Buffer buffer_;
  size_t count_;
};

/// The reference result by std::stable_sort, with the start table if `withStart`.
Sorted expected(std::span<const uint32_t> keys, uint64_t keyRange, bool withStart);

class SortTest : public GpuTest {
 protected:
  using Declare = std::function<void(Graph&)>;
  /// Declares and runs one frame, and waits for it.
  void runGraph(const Declare& declare) { runGraphs({declare}); }
  /// One graph per function, all recorded into one command buffer.
  void runGraphs(const std::vector<Declare>& declares);

  WordBuffer words(size_t count, uint32_t filling = 0) { return {device(), count, filling}; }
  WordBuffer words(const Words& content) { return {device(), content}; }

  /// Sorts on the device and returns all outputs that `desc` requests.
  Sorted sorted(const KeySortDesc& desc, const Words& keys);
};

}  // namespace rill::test
