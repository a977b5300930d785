// The graph on a real driver, with synchronization validation: dispatches, copies, read-backs.
#include <numeric>

#include "support/gpu_test.hpp"

namespace rill::test {
namespace graph_runs_test {

constexpr BindingKind kTwoBuffers[] = {BindingKind::Storage, BindingKind::Storage};
constexpr BindingKind kOneBuffer[] = {BindingKind::Storage};
constexpr BindingKind kTexelAndBuffer[] = {BindingKind::TexelFloat4, BindingKind::Storage};

struct AddPush {
  uint32_t count, amount;
};

class GraphOnGpu : public GpuTest {
 protected:
  const ComputePipeline* add() {
    return pipeline({.shader = "add", .spirv = testShader("add"), .bindings = kTwoBuffers, .pushConstantBytes = sizeof(AddPush)});
  }
  const ComputePipeline* count() { return pipeline({.shader = "count", .spirv = testShader("count"), .bindings = kOneBuffer}); }

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
  EXPECT_LT(graph.transientBytes(), 3 * 4096u) << "five steps alias to the memory of two";
}

TEST_F(GraphOnGpu, FoldsGroupsAboveDimensionLimit) {
  Graph graph;
  const uint64_t groups = 65535 + 1000;
  BufferRef counter = graph.create("counter", {4});
  graph.pass("clear", [&](Pass& pass) {
    counter = pass.write(counter, Use::CopyTarget);
    return [=](Commands& commands) { commands.fill(counter, 0); };
  });
  graph.pass("count", [&](Pass& pass) {
    counter = pass.write(counter, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(count(), {counter});
    return [=](Commands& commands) {
      commands.dispatch(kernel, groups);
      commands.dispatch(kernel, 0);
    };
  });
  const Ticket ticket = graph.readback(counter);
  run(graph);
  const auto result = read<uint32_t>(graph, ticket);
  ASSERT_EQ(result.size(), 1u);
  EXPECT_EQ(result[0] % 64, 0u);
  EXPECT_EQ(result[0] / 64, groups + groups % 2) << "two rows of equal length";
}

TEST_F(GraphOnGpu, DispatchesIndirect) {
  constexpr BindingKind kinds[] = {BindingKind::Storage};
  Graph graph;
  BufferRef arguments = graph.create("arguments", {16}), counter = graph.create("counter", {4});
  graph.pass("clear", [&](Pass& pass) {
    counter = pass.write(counter, Use::CopyTarget);
    return [=](Commands& commands) { commands.fill(counter, 0); };
  });
  graph.pass("arguments", [&](Pass& pass) {
    arguments = pass.write(arguments, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(
        pipeline({.shader = "arguments", .spirv = testShader("arguments"), .bindings = kinds, .pushConstantBytes = 4}), {arguments});
    return [=](Commands& commands) { commands.dispatch(kernel, 1, uint32_t(13)); };
  });
  graph.pass("count", [&](Pass& pass) {
    pass.read(arguments, Use::Indirect);
    counter = pass.write(counter, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(count(), {counter});
    return [=](Commands& commands) { commands.dispatchIndirect(kernel, arguments, 0); };
  });
  const Ticket ticket = graph.readback(counter);
  run(graph);
  EXPECT_EQ(read<uint32_t>(graph, ticket), std::vector<uint32_t>{13 * 64});
}

TEST_F(GraphOnGpu, ReadsTexelsOfImportsAndTransients) {
  std::vector<float> numbers(400);
  std::iota(numbers.begin(), numbers.end(), 0.0f);
  const Buffer source = upload("source", numbers);
  Graph graph;
  BufferRef imported = graph.import("source", importOf(source));
  BufferRef copy = graph.create("copy", {1600});
  graph.pass("copy", [&](Pass& pass) {
    pass.read(imported, Use::CopySource);
    copy = pass.write(copy, Use::CopyTarget);
    return [=](Commands& commands) { commands.copy(imported, copy, 1600); };
  });
  Ticket tickets[2];
  const ComputePipeline* texel =
      pipeline({.shader = "texel", .spirv = testShader("texel"), .bindings = kTexelAndBuffer, .pushConstantBytes = 4});
  for (int i = 0; i < 2; ++i) {
    const BufferRef from = i == 0 ? imported : copy;
    BufferRef sums = graph.create("sums", {400});
    graph.pass("texel", [&](Pass& pass) {
      pass.read(from, Use::ComputeTexel);
      sums = pass.write(sums, Use::ComputeWrite);
      const Kernel kernel = pass.kernel(texel, {from, sums});
      return [=](Commands& commands) { commands.dispatch(kernel, 2, uint32_t(100)); };
    });
    tickets[i] = graph.readback(sums);
  }
  run(graph);
  for (const Ticket ticket : tickets) {
    const auto sums = read<float>(graph, ticket);
    ASSERT_EQ(sums.size(), 100u);
    for (size_t i = 0; i < 100; ++i) ASSERT_EQ(sums[i], float(16 * i + 6));
  }
}

// Synchronization validation only checks within a command buffer, so three frames share one: the second
// frame's use of the transient memory must wait for the first.
TEST_F(GraphOnGpu, FramesInOneCommandBufferShareTheHeap) {
  std::vector<uint32_t> numbers(5000, 1);
  const Buffer source = upload("source", numbers);
  const Buffer state = buffer("state", 20000);
  Graph graph;
  Ticket tickets[3];
  auto submitted = context().submit([&](VkCommandBuffer commandBuffer) {
    for (int frame = 0; frame < 3; ++frame) {
      graph.reset();
      const BufferRef in = graph.import("source", importOf(source));
      BufferRef kept = graph.import("state", importOf(state, frame == 0 ? Use::Nothing : Use::ComputeRead, Use::ComputeRead));
      BufferRef at = frame == 0 ? in : kept;
      for (int i = 0; i < 4; ++i) at = addPass(graph, "add", at, graph.create("step", {20000}), 5000, 1);
      kept = addPass(graph, "store", at, kept, 5000, 1);
      BufferRef scratch = graph.create("scratch", {20000});
      graph.pass("fill", [&](Pass& pass) {
        scratch = pass.write(scratch, Use::CopyTarget);
        pass.sideEffect();
        return [=](Commands& commands) { commands.fill(scratch, 99); };
      });
      tickets[frame] = graph.readback(kept);
      auto ok = graph.compile();
      if (ok) ok = graph.prepare(device());
      ASSERT_TRUE(ok) << ok.error().message;
      graph.record(commandBuffer);
      EXPECT_TRUE(graph.data(tickets[frame]).empty()) << "in flight";
    }
  });
  ASSERT_TRUE(submitted);
  ASSERT_TRUE(context().wait());
  for (uint32_t frame = 0; frame < 3; ++frame) {
    const auto result = read<uint32_t>(graph, tickets[frame]);
    ASSERT_EQ(result.size(), 5000u);
    for (uint32_t value : result) ASSERT_EQ(value, 1 + 5 * (frame + 1));
  }
  graph.reset();
  EXPECT_TRUE(graph.data(tickets[0]).empty()) << "returned spans are valid until the next reset()";
}

TEST_F(GraphOnGpu, AtomicsCommute) {
  Graph graph;
  BufferRef counter = graph.create("counter", {4});
  graph.pass("clear", [&](Pass& pass) {
    counter = pass.write(counter, Use::CopyTarget);
    return [=](Commands& commands) { commands.fill(counter, 0); };
  });
  for (int i = 0; i < 3; ++i)
    graph.pass("count", [&](Pass& pass) {
      counter = pass.write(counter, Use::ComputeAtomic);
      const Kernel kernel = pass.kernel(count(), {counter});
      return [=](Commands& commands) { commands.dispatch(kernel, 10); };
    });
  const Ticket ticket = graph.readback(counter);
  run(graph);
  EXPECT_EQ(read<uint32_t>(graph, ticket), std::vector<uint32_t>{3 * 10 * 64});
}

// Proves that validation is active: an undeclared write is reported as a hazard. (Two storage writes would
// not be reported, because the layer assumes atomics.)
TEST_F(GraphOnGpu, ValidationReportsHazards) {
  const Buffer source = buffer("source", 4096), target = buffer("target", 4096);
  Graph graph;
  const BufferRef in = graph.import("source", importOf(source));
  BufferRef out = graph.import("target", importOf(target));
  graph.pass("dispatch and fill", [&](Pass& pass) {
    pass.read(in, Use::ComputeRead);
    out = pass.write(out, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(add(), {in, out});
    return [=](Commands& commands) {
      commands.dispatch(kernel, 1, AddPush{64, 1});
      commands.fill(out, 1);
    };
  });
  run(graph);
  const auto messages = context().takeMessages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("SYNC-HAZARD"), std::string::npos) << messages[0];
}

TEST_F(GraphOnGpu, AbandonedFrameHasNoResults) {
  const Buffer source = upload("source", std::vector<uint32_t>(64, 5));
  Graph graph;
  const Ticket lost = graph.readback(graph.import("source", importOf(source)));
  auto clock = context().beginFrame();
  ASSERT_TRUE(clock);
  ASSERT_TRUE(graph.compile());
  ASSERT_TRUE(graph.prepare(device()));
  device().abandon(clock->recording);
  ASSERT_TRUE(context().submit([](VkCommandBuffer) {}));  // submits the frame without the graph
  ASSERT_TRUE(context().wait());
  EXPECT_TRUE(graph.data(lost).empty());
  EXPECT_TRUE(graph.timings().empty());
}

}  // namespace graph_runs_test
}  // namespace rill::test
