// prepare() and record() on a device that only records calls.
#include <optional>

#include "bench/count_allocations.hpp"
#include "graph_fixture.hpp"
#include "support/null_vulkan.hpp"

namespace rill::test {
namespace {

constexpr uint32_t kWords[] = {0x07230203, 0x10000, 0, 1, 0};

class Recording : public GraphTest {
 protected:
  Recording() {
    auto borrowed = Device::borrow(vulkan.host());
    EXPECT_TRUE(borrowed);
    device = std::move(*borrowed);
    vulkan.commands.reserve(1 << 16);
  }
  ~Recording() override { owned.reset(); }
  const ComputePipeline* pipeline(std::string_view name, std::initializer_list<BindingKind> kinds) {
    auto made = computePipeline(*device, {.shader = name, .spirv = kWords, .bindings = std::span(kinds.begin(), kinds.size())});
    EXPECT_TRUE(made);
    return *made;
  }
  void frame() {
    ++clock.recording;
    clock.completed = clock.recording - 2;
    device->beginFrame(clock);
  }
  Expected<void> go() {
    auto ok = graph.compile();
    if (ok) ok = graph.prepare(*device);
    if (ok) graph.record(NullVulkan::commandBuffer());
    return ok;
  }
  void declareLargeFrame(const ComputePipeline* update, const ComputePipeline* texel, uint64_t scratchBytes = 1024) {
    BufferRef state = graph.import("state", {fakeBuffer(1), 0, 4096, Use::ComputeWrite, Use::ComputeWrite});
    BufferRef list = graph.import("list", {fakeBuffer(2), 0, 4096, Use::ComputeWrite, Use::ComputeWrite});
    for (int i = 0; i < 100; ++i) {
      BufferRef scratch = graph.create("scratch of both, with a long name", {scratchBytes});
      const std::array<uint64_t, 20> much{};  // a large capture
      graph.pass("first of the two, with a long name", [&](Pass& pass) {
        pass.read(list, Use::ComputeTexel);
        scratch = pass.write(scratch, Use::ComputeWrite);
        const Kernel kernel = pass.kernel(texel, {list, scratch});
        return [kernel, much](Commands& commands) { commands.dispatch(kernel, 100 + much[3]); };
      });
      graph.pass("second", [&](Pass& pass) {
        pass.read(scratch, Use::ComputeRead);
        state = pass.write(state, Use::ComputeWrite);
        const Kernel kernel = pass.kernel(update, {scratch, state});
        return [kernel](Commands& commands) { commands.dispatch(kernel, 100); };
      });
    }
    (void)graph.readback(state);
  }

  NullVulkan vulkan;
  std::optional<Device> device;
  FrameClock clock;
};

TEST_F(Recording, SteadyStateAllocatesNothing) {
  const auto* update = pipeline("update", {BindingKind::Storage, BindingKind::Storage});
  const auto* texel = pipeline("texel", {BindingKind::TexelFloat4, BindingKind::Storage});
  for (const uint64_t other : {1024, 768}) {  // frames that reuse the plan, then frames that need a new plan each
    const auto wholeFrame = [&](int i) {
      frame();
      graph.reset();
      vulkan.commands.clear();
      declareLargeFrame(update, texel, i % 2 == 0 ? 1024 : other);
      return bool(go()) && graph.timings().size() <= 3;
    };
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(wholeFrame(i));  // until forgotten read-backs expire
    const int64_t live = vulkan.liveObjects;
    const uint64_t plans = implOf(graph).plansMade;
    bench::startCounting();
    bool fine = true;
    for (int i = 0; i < 40; ++i) fine = wholeFrame(i) && fine;
    const size_t allocations = bench::stopCounting();
    EXPECT_TRUE(fine);
    EXPECT_EQ(allocations, 0u);
    EXPECT_EQ(implOf(graph).plansMade - plans, other == 1024 ? 0u : 40u);
    EXPECT_EQ(vulkan.liveObjects, live) << "every frame destroys the views that it created";
  }
}

TEST_F(Recording, EqualBindingsShareDescriptorSetAndView) {
  const auto* texel = pipeline("texel", {BindingKind::TexelFloat4, BindingKind::Storage});
  const auto* other = pipeline("other", {BindingKind::TexelFloat4, BindingKind::Storage});
  frame();
  BufferRef in = import("in"), out = import("out");
  for (int i = 0; i < 10; ++i)
    graph.pass("pass", [&](Pass& pass) {
      pass.read(in, Use::ComputeTexel);
      out = pass.write(out, Use::ComputeWrite);
      const Kernel kernel = pass.kernel(i % 2 ? texel : other, {in, out});
      return [=](Commands& commands) { commands.dispatch(kernel, 1); };
    });
  ASSERT_TRUE(go());
  EXPECT_EQ(vulkan.setsAllocated, 1u);
  EXPECT_EQ(vulkan.viewsCreated, 1u);
  EXPECT_EQ(vulkan.count(NullCommand::Dispatch), 10u);
}

TEST_F(Recording, PassHasAtMostOneBarrierAndTwoTimestamps) {
  const auto* update = pipeline("update", {BindingKind::Storage, BindingKind::Storage});
  const auto* texel = pipeline("texel", {BindingKind::TexelFloat4, BindingKind::Storage});
  frame();
  declareLargeFrame(update, texel);
  ASSERT_TRUE(go());
  EXPECT_LE(vulkan.count(NullCommand::Barrier), 202u);
  EXPECT_EQ(vulkan.count(NullCommand::Timestamp), 201u + 1);
  for (const NullCommand& command : vulkan.commands) {
    if (command.kind == NullCommand::Barrier) { EXPECT_EQ(command.handle, 1u) << "one memory barrier"; }
  }
}

TEST_F(Recording, RecordingIsIndependentOfFramesInFlight) {
  const auto* update = pipeline("update", {BindingKind::Storage, BindingKind::Storage});
  const auto* texel = pipeline("texel", {BindingKind::TexelFloat4, BindingKind::Storage});
  const auto barriers = [&] {
    graph.reset();
    vulkan.commands.clear();
    declareLargeFrame(update, texel);
    EXPECT_TRUE(go());
    std::vector<std::array<uint64_t, 4>> list;
    for (const NullCommand& c : vulkan.commands)
      if (c.kind == NullCommand::Barrier)
        list.push_back({c.barrier.srcStageMask, c.barrier.srcAccessMask, c.barrier.dstStageMask, c.barrier.dstAccessMask});
    return list;
  };
  device->beginFrame({1, 0});
  const auto first = barriers();
  device->beginFrame({2, 0});
  EXPECT_EQ(barriers(), first);
  device->beginFrame({3, 2});
  EXPECT_EQ(barriers(), first);
}

TEST_F(Recording, FoldsLargeDispatchesAndSkipsEmptyOnes) {
  const auto* update = pipeline("update", {BindingKind::Storage});
  frame();
  BufferRef out = import("out");
  graph.pass("pass", [&](Pass& pass) {
    out = pass.write(out, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(update, {out});
    return [=](Commands& commands) {
      for (uint64_t groups : {uint64_t(0), uint64_t(1), uint64_t(65535), uint64_t(65536), uint64_t(1'000'000)})
        commands.dispatch(kernel, groups);
    };
  });
  ASSERT_TRUE(go());
  std::vector<std::array<uint64_t, 2>> sizes;
  for (const NullCommand& c : vulkan.commands)
    if (c.kind == NullCommand::Dispatch) sizes.push_back({c.a, c.b});
  EXPECT_EQ(sizes, (std::vector<std::array<uint64_t, 2>>{{1, 1}, {65535, 1}, {32768, 2}, {62500, 16}}));
}

TEST_F(Recording, OutOfMemoryNamesBufferAndRetrySucceeds) {
  frame();
  read("look", write("make", graph.create("scratch", {1 << 20})));
  vulkan.allocationResult = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const int64_t live = vulkan.liveObjects;
  auto ok = go();
  ASSERT_FALSE(ok);
  EXPECT_EQ(ok.error().kind, ErrorKind::OutOfMemory);
  EXPECT_NE(ok.error().message.find("'transients': out of device memory"), std::string::npos) << ok.error().message;
  vulkan.allocationResult = VK_SUCCESS;
  ok = go();
  EXPECT_TRUE(ok);
  for (int i = 0; i < 3; ++i) frame();
  EXPECT_EQ(vulkan.liveObjects, live + 3) << "the heap, its memory and a query pool; the failed buffer was destroyed";
}

TEST_F(Recording, OutgrownHeapsOutliveTheirFrames) {
  frame();
  read("look", write("make", graph.create("scratch", {1000})));
  ASSERT_TRUE(go());
  const size_t buffers = vulkan.buffersCreated;
  frame();
  graph.reset();
  read("look", write("make", graph.create("scratch", {2000})));
  ASSERT_TRUE(go());
  EXPECT_EQ(vulkan.buffersCreated, buffers) << "small heaps have room to grow";
  const int64_t live = vulkan.liveObjects;
  frame();
  graph.reset();
  read("look", write("make", graph.create("scratch", {1 << 20})));
  ASSERT_TRUE(go());
  EXPECT_EQ(vulkan.buffersCreated, buffers + 1);
  EXPECT_GE(vulkan.liveObjects, live + 2) << "frames in flight still use the old heap";
}

TEST_F(Recording, RejectsMisalignedImport) {
  frame();
  read("look", graph.import("a", {fakeBuffer(9), 20, 64}));
  const auto ok = go();
  ASSERT_FALSE(ok);
  EXPECT_EQ(ok.error().message, "import 'a': offset 20 is not a multiple of 64");
}

TEST_F(Recording, RejectsBindingsAboveDeviceLimits) {
  const auto* texel = pipeline("texel", {BindingKind::TexelUint});
  const auto* uniform = pipeline("uniform", {BindingKind::Uniform});
  const auto attempt = [&](const ComputePipeline* with, Use use) {
    frame();
    graph.reset();
    const BufferRef big = write("make", graph.create("big", {1 << 20}));
    graph.pass("look", [&](Pass& pass) {
      pass.read(big, use);
      pass.sideEffect();
      const Kernel kernel = pass.kernel(with, {big});
      return [=](Commands& commands) { commands.dispatch(kernel, 1); };
    });
    const auto ok = go();
    return ok ? std::string() : ok.error().message;
  };
  EXPECT_EQ(attempt(texel, Use::ComputeTexel), "texel buffer 'big' of 262144 texels; null device supports 1 to 65536");
  EXPECT_EQ(attempt(uniform, Use::ComputeUniform), "buffer 'big' of 1048576 bytes; null device binds at most 65536");
}

TEST_F(Recording, TimingsSumPassesByNameAfterCompletion) {
  device->beginFrame({1, 0});
  BufferRef out = import("out");
  out = write("step", out);
  out = write("step", out);
  read("look", out);
  ASSERT_TRUE(go());
  EXPECT_TRUE(graph.timings().empty()) << "in flight";
  device->beginFrame({2, 1});
  ASSERT_EQ(graph.timings().size(), 2u);
  EXPECT_EQ(graph.timings()[0].name, "step");
  EXPECT_EQ(graph.timings()[0].runs, 2u);
  EXPECT_DOUBLE_EQ(graph.timings()[0].ms, 0.002);
  graph.reset();
  graph.enableTimings(false);
  vulkan.commands.clear();
  read("look", import("a"));
  ASSERT_TRUE(go());
  EXPECT_EQ(vulkan.count(NullCommand::Timestamp), 0u);
}

TEST_F(Recording, ForgottenReadbacksExpire) {
  const auto* update = pipeline("update", {BindingKind::Storage});
  (void)update;
  std::vector<Ticket> tickets;
  for (int i = 0; i < 60; ++i) {
    frame();
    graph.reset();
    tickets.push_back(graph.readback(import("a")));
    ASSERT_TRUE(go());
  }
  EXPECT_LE(implOf(graph).slots.size(), 20u);
  EXPECT_TRUE(graph.data(tickets[0]).empty());
  EXPECT_EQ(graph.data(tickets[56]).size(), 1024u);
  EXPECT_TRUE(graph.data(tickets[59]).empty()) << "in flight";
}

TEST_F(Recording, DestroysAllObjects) {
  const auto* update = pipeline("update", {BindingKind::Storage, BindingKind::Storage});
  const auto* texel = pipeline("texel", {BindingKind::TexelFloat4, BindingKind::Storage});
  device->beginFrame({1, 0});
  declareLargeFrame(update, texel);
  ASSERT_TRUE(go());
  owned.reset();
  device.reset();
  EXPECT_EQ(vulkan.liveObjects, 0);
}

}  // namespace
}  // namespace rill::test
