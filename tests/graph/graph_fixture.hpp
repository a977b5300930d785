#pragma once
// Helpers to declare passes in one line, for tests of the plan that compile() makes.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "gpu/pipeline.hpp"
#include "graph/graph_impl.hpp"
#include "rill/graph.hpp"

namespace rill::test {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                kIndirect = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                kHost = VK_PIPELINE_STAGE_2_HOST_BIT;
constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT, kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                         kSampled = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, kIndirectRead = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
                         kTransferRead = VK_ACCESS_2_TRANSFER_READ_BIT, kTransferWrite = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                         kHostRead = VK_ACCESS_2_HOST_READ_BIT, kMemoryWrite = VK_ACCESS_2_MEMORY_WRITE_BIT;

class GraphTest : public ::testing::Test {
 protected:
  static VkBuffer fakeBuffer(uint64_t n) { return reinterpret_cast<VkBuffer>(n); }
  BufferRef import(std::string_view name, Use before = Use::Nothing, Use after = Use::Nothing) {
    return graph.import(name, {fakeBuffer(++imports_), 0, 1024, before, after});
  }
  BufferRef write(std::string_view pass, BufferRef buffer, Use use = Use::ComputeWrite, bool discard = false) {
    graph.pass(pass, [&](Pass& p) {
      buffer = p.write(buffer, use, discard);
      return [](Commands&) {};
    });
    return buffer;
  }
  BufferRef readWrite(std::string_view pass, BufferRef from, Use use, BufferRef to, Use target = Use::ComputeWrite) {
    graph.pass(pass, [&](Pass& p) {
      p.read(from, use);
      to = p.write(to, target);
      return [](Commands&) {};
    });
    return to;
  }
  void read(std::string_view pass, BufferRef buffer, Use use = Use::ComputeRead, bool root = true) {
    graph.pass(pass, [&](Pass& p) {
      p.read(buffer, use);
      if (root) p.sideEffect();
      return [](Commands&) {};
    });
  }
  void compile() {
    const auto ok = graph.compile();
    ASSERT_TRUE(ok) << ok.error().message;
  }
  /// The error message of compile(), or "compiled".
  std::string compileError() {
    const auto ok = graph.compile();
    if (ok) return "compiled";
    EXPECT_EQ(ok.error().kind, ErrorKind::BadInput);
    return ok.error().message;
  }
  Scope barrier(size_t pass) { return implOf(graph).passes[pass].barrier.scope; }
  bool alive(size_t pass) { return implOf(graph).passes[pass].alive; }

  std::unique_ptr<Graph> owned = std::make_unique<Graph>();  // a test with a device destroys it before the device
  Graph& graph = *owned;

 private:
  uint64_t imports_ = 0;
};

/// A pipeline without Vulkan objects, sufficient to declare kernels.
struct FakePipeline {
  explicit FakePipeline(std::initializer_list<BindingKind> kinds) : set{kinds} {
    pipeline.shader = "fake";
    pipeline.set = &set;
  }
  SetLayout set;
  ComputePipeline pipeline;
};

inline void PrintTo(const Scope& scope, std::ostream* out) {
  *out << std::hex << "{" << scope.sourceStage << ", " << scope.sourceAccess << " -> " << scope.targetStage << ", " << scope.targetAccess
       << "}" << std::dec;
}

}  // namespace rill::test

namespace rill {
using test::PrintTo;
}
