// The graph on a real driver: what is dispatched, copied and read back, with synchronization validation listening.
#include <numeric>

#include "support/gpu_test.hpp"

namespace rill::test {
namespace {

constexpr BindingKind kTwoBuffers[] = {BindingKind::Storage, BindingKind::Storage};
constexpr BindingKind kOneBuffer[] = {BindingKind::Storage};
constexpr BindingKind kTexelAndBuffer[] = {BindingKind::TexelFloat4, BindingKind::Storage};

struct AddPush {
  uint32_t count, amount;
};

class GraphOnGpu : public GpuTest {
 protected:
  const ComputePipeline* add() {
    return pipeline({.shader = "add", .bindings = kTwoBuffers, .pushConstantBytes = sizeof(AddPush), .words = testShader("add")});
  }
  const ComputePipeline* count() { return pipeline({.shader = "count", .bindings = kOneBuffer, .words = testShader("count")}); }

  BufferRef addPass(Graph& graph, std::string_view name, BufferRef source, BufferRef target, uint32_t elements, uint32_t amount) {
    BufferRef out;
    graph.pass(name, [&](Pass& pass) {
      pass.read(source, Use::ComputeRead);
      out = pass.write(target, Use::ComputeWrite, true);
      const Kernel kernel = pass.kernel(add(), {source, out});
      return [=](Commands& commands) { commands.dispatch(kernel, (elements + 63) / 64, AddPush{elements, amount}); };
    });
    return out;
  }
};

TEST_F(GraphOnGpu, AddsThroughTransients) {
  std::vector<uint32_t> numbers(1000);
  std::iota(numbers.begin(), numbers.end(), 0u);
  const Buffer source = upload("source", numbers);
  Graph graph;
  BufferRef at = graph.import("source", importOf(source));
  for (int i = 0; i < 5; ++i) at = addPass(graph, "add", at, graph.create("step", {4000}), 1000, 7);
  const Ticket ticket = graph.readback(at);
  run(graph);
  const auto result = read<uint32_t>(graph, ticket);
  ASSERT_EQ(result.size(), 1000u);
  for (uint32_t i = 0; i < 1000; ++i) ASSERT_EQ(result[i], i + 35);
  ASSERT_EQ(graph.timings().size(), 2u);
  EXPECT_EQ(graph.timings()[0].name, "add");
  EXPECT_EQ(graph.timings()[0].runs, 5u);
  EXPECT_GT(graph.timings()[0].ms, 0);
  EXPECT_LT(graph.transientBytes(), 3 * 4096u) << "five steps need the memory of two";
}

}  // namespace
}  // namespace rill::test
