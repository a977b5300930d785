// Aliasing of transients. Plans are corrupted between compile() and prepare() (missing barriers, overlapping
// lifetimes); synchronization validation or wrong results must reveal it. Unmodified plans are clean.
#include "graph/graph_impl.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace graph_aliasing_test {

constexpr uint32_t kWords = 4096, kFrames = 3;
constexpr ImageDesc kDesc{VK_FORMAT_R32_UINT, 64, 64};
static_assert(kDesc.width * kDesc.height == kWords);

using Corruption = void (*)(GraphImpl& graph, uint32_t frame);

uint32_t valueOf(uint32_t frame, uint32_t which) { return 100 * (frame + 1) + which; }

class Aliasing : public GpuTest {
 public:
  /// Buffers a and b with disjoint lifetimes in the same memory, each filled and copied out.
  void declareBuffers(Graph& graph, BufferRef& out, uint32_t frame) {
    for (uint32_t which = 0; which < 2; ++which) {
      BufferRef part = graph.create(which == 0 ? "a" : "b", {kWords * 4});
      graph.pass("fill", [&](Pass& pass) {
        part = pass.write(part, Use::CopyTarget);
        return [=](Commands& commands) { commands.fill(part, valueOf(frame, which)); };
      });
      copyOut(graph, part, out, which);
    }
  }
  /// Both are filled before either is copied out, so their lifetimes overlap.
  void declareTogether(Graph& graph, BufferRef& out, uint32_t frame) {
    BufferRef parts[2] = {graph.create("a", {kWords * 4}), graph.create("b", {kWords * 4})};
    for (uint32_t which = 0; which < 2; ++which)
      graph.pass("fill", [&](Pass& pass) {
        parts[which] = pass.write(parts[which], Use::CopyTarget);
        return [=, part = parts[which]](Commands& commands) { commands.fill(part, valueOf(frame, which)); };
      });
    for (uint32_t which = 0; which < 2; ++which) copyOut(graph, parts[which], out, which);
  }
  /// As declareBuffers(), with images.
  void declareImages(Graph& graph, BufferRef& out, uint32_t frame) {
    for (uint32_t which = 0; which < 2; ++which) {
      ImageRef part = graph.create(which == 0 ? "a" : "b", kDesc);
      graph.pass("clear", [&](Pass& pass) {
        part = pass.write(part, Use::CopyTarget);
        VkClearColorValue value{};
        value.uint32[0] = valueOf(frame, which);
        return [=](Commands& commands) { commands.clear(part, value); };
      });
      graph.pass("copy", [&](Pass& pass) {
        pass.read(part, Use::CopySource);
        out = pass.write(out, Use::CopyTarget);
        return [=, to = out](Commands& commands) { commands.copy(part, to, uint64_t{which} * kWords * 4); };
      });
    }
  }

  using Declare = void (Aliasing::*)(Graph&, BufferRef&, uint32_t);
  /// Runs three frames in one command buffer and returns the validation messages. Sets `wrong` to the number
  /// of wrong result words.
  std::vector<std::string> go(Declare declare, Corruption corrupt) {
    Graph graph;
    Buffer results[kFrames];
    Ticket tickets[kFrames];
    {  // the first frame queries the image sizes, which changes the plan
      const Buffer result = buffer("out", 2 * kWords * 4);
      BufferRef out = graph.import("out", importOf(result));
      (this->*declare)(graph, out, 0);
      run(graph);
      implOf(graph).previousPlan.valid = implOf(graph).planComplete = false;
    }
    const auto submitted = context().submit([&](VkCommandBuffer commands) {
      for (uint32_t frame = 0; frame < kFrames; ++frame) {
        graph.reset();
        results[frame] = buffer("out", 2 * kWords * 4);
        BufferRef out = graph.import("out", importOf(results[frame]));
        (this->*declare)(graph, out, frame);
        tickets[frame] = graph.readback(out);
        declareLast(graph);
        auto ok = graph.compile();
        if (ok) {
          corrupt(implOf(graph), frame);
          ok = graph.prepare(device());
        }
        ASSERT_TRUE(ok) << ok.error().message;
        graph.record(commands);
        implOf(graph).planComplete = false;  // the next frame needs a new plan to corrupt
      }
    });
    EXPECT_TRUE(submitted);
    EXPECT_TRUE(context().wait());
    wrong = 0;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
      const auto words = read<uint32_t>(graph, tickets[frame]);
      EXPECT_EQ(words.size(), size_t{2} * kWords);
      for (size_t i = 0; i < words.size(); ++i) wrong += words[i] != valueOf(frame, uint32_t(i / kWords));
    }
    return context().takeMessages();
  }
  static bool namesHazard(const std::vector<std::string>& messages) {
    for (const std::string& message : messages)
      if (message.find("SYNC-HAZARD") != std::string::npos) return true;
    return false;
  }
  size_t wrong = 0;

 private:
  /// A last pass, without which the read-back's barriers would also order the next frame.
  void declareLast(Graph& graph) {
    BufferRef last = graph.create("last", {kWords * 4});
    graph.pass("last", [&](Pass& pass) {
      last = pass.write(last, Use::CopyTarget);
      pass.sideEffect();
      return [=](Commands& commands) { commands.fill(last, 0); };
    });
  }
  void copyOut(Graph& graph, BufferRef part, BufferRef& out, uint32_t which) {
    graph.pass("copy", [&](Pass& pass) {
      pass.read(part, Use::CopySource);
      out = pass.write(out, Use::CopyTarget);
      return [=, to = out](Commands& commands) { commands.copy(part, to, kWords * 4, 0, uint64_t{which} * kWords * 4); };
    });
  }
};

void unmodified(GraphImpl&, uint32_t) {}
void expectSharedMemory(const GraphImpl& graph, bool images) {
  const auto& placements = graph.plans[images].placements;
  ASSERT_GE(placements.size(), 2u);
  EXPECT_TRUE(sharesMemory(placements[0], placements[1]));
}

TEST_F(Aliasing, UnmodifiedPlansAreCleanAndCorrect) {
  for (const Declare declare : {&Aliasing::declareBuffers, &Aliasing::declareTogether, &Aliasing::declareImages}) {
    EXPECT_EQ(go(declare, unmodified), std::vector<std::string>{});
    EXPECT_EQ(wrong, 0u);
  }
}

TEST_F(Aliasing, ReportsMissingWaitOnReuse) {
  const auto messages = go(&Aliasing::declareBuffers, [](GraphImpl& graph, uint32_t) {
    expectSharedMemory(graph, false);
    ASSERT_FALSE(graph.passes[2].barrier.empty()) << "b waits for a";
    graph.passes[2].barrier = {};
  });
  EXPECT_TRUE(namesHazard(messages));
}

TEST_F(Aliasing, ReportsMissingWaitForPreviousFrame) {
  const auto messages = go(&Aliasing::declareBuffers, [](GraphImpl& graph, uint32_t frame) {
    ASSERT_FALSE(graph.passes[0].barrier.empty()) << "a waits for the previous frame";
    if (frame > 0) graph.passes[0].barrier = {};
  });
  EXPECT_TRUE(namesHazard(messages));
}

TEST_F(Aliasing, ReportsOverlappingLifetimesAndCorruptsResults) {
  const auto messages = go(&Aliasing::declareTogether, [](GraphImpl& graph, uint32_t) {
    auto& placements = graph.plans[0].placements;
    ASSERT_GE(placements.size(), 2u);
    ASSERT_FALSE(sharesMemory(placements[0], placements[1]));
    placements[1].offset = placements[0].offset;
  });
  EXPECT_TRUE(namesHazard(messages));
  EXPECT_GT(wrong, 0u);
}

TEST_F(Aliasing, ReportsMissingImageTransitionWait) {
  const auto messages = go(&Aliasing::declareImages, [](GraphImpl& graph, uint32_t) {
    expectSharedMemory(graph, true);
    const Range changes = graph.passes[2].barrier.transitions;
    ASSERT_EQ(changes.count, 1u);
    Scope& scope = graph.transitions[changes.first].scope;
    ASSERT_NE(scope.sourceStage, 0u) << "b waits for a";
    scope.sourceStage = scope.sourceAccess = 0;
  });
  EXPECT_TRUE(namesHazard(messages));
}

}  // namespace graph_aliasing_test
}  // namespace rill::test
