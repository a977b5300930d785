#pragma once
// Tests on the driver selected by the environment (VK_DRIVER_FILES), with validation and synchronization
// validation unless RILL_TEST_VALIDATION is "off". Any message fails the test.
#include <gtest/gtest.h>

#include <span>
#include <string_view>
#include <vector>

#include "gpu/resources.hpp"
#include "offline/context.hpp"
#include "rill/graph.hpp"

namespace rill::test {

/// SPIR-V of tests/support/shaders/NAME.comp.
std::span<const uint32_t> testShader(std::string_view name);

/// One context per test program, since opening a device takes longer than most tests.
class GpuTest : public ::testing::Test {
 protected:
  /// Throws the reason if there is no device: GoogleTest then runs neither the rest of a SetUp() nor the test.
  void SetUp() override;
  void TearDown() override;

  offline::Context& context() { return *context_; }
  Device& device() { return context_->device(); }
  /// Runs the graph as one frame and waits for it; a failure fails the test.
  void run(Graph& graph);
  /// Runs several graphs, recorded into one command buffer in this order.
  void run(std::span<Graph* const> graphs);
  /// A host-visible buffer with this content.
  template <class T>
  Buffer upload(std::string_view name, std::span<const T> data) {
    return uploadBytes(name, std::as_bytes(data));
  }
  template <class T>
  Buffer upload(std::string_view name, const std::vector<T>& data) {
    return uploadBytes(name, std::as_bytes(std::span(data)));
  }
  Buffer buffer(std::string_view name, uint64_t bytes, MemoryKind kind = MemoryKind::Device);
  const ComputePipeline* pipeline(const ComputePipelineDesc& desc);
  /// What a test shader writes to binding 1, cleared before, from `source` at binding 0.
  std::vector<uint32_t> wordsFrom(std::string_view shader, const Buffer& source, uint64_t words, uint32_t groups);

  static BufferImport importOf(const Buffer& buffer, Use before = Use::Nothing, Use after = Use::Nothing) {
    return {buffer.handle(), 0, buffer.size(), before, after};
  }
  /// The read-back data as a vector of T; empty if not available.
  template <class T>
  static std::vector<T> read(const Graph& graph, Ticket ticket) {
    const auto bytes = graph.data(ticket);
    const auto* first = reinterpret_cast<const T*>(bytes.data());
    return {first, first + bytes.size() / sizeof(T)};
  }

 private:
  Buffer uploadBytes(std::string_view name, std::span<const std::byte> bytes);
  offline::Context* context_ = nullptr;
};

}  // namespace rill::test
