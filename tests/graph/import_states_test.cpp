// Import states that no pass has (swapchain images, custom states), and usage flags of imports.
#include "graph_fixture.hpp"

namespace rill::test {
namespace {

constexpr ImageDesc kDesc{VK_FORMAT_R8G8B8A8_UNORM, 64, 32};
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr UseState kSampledInGeneral{.stages = kFragment, .access = kSampled, .layout = VK_IMAGE_LAYOUT_GENERAL};

class ImportStates : public GraphTest {
 protected:
  ImageRef image(ImportState before, ImportState after, VkImageUsageFlags usage = 0) {
    return graph.import("image", {reinterpret_cast<VkImage>(uintptr_t(1)), kDesc, before, after, usage});
  }
  void draw(ImageRef target, Use use, Load load = Load::Keep) {
    graph.pass("draw", [&](Pass& pass) {
      (void)pass.write(target, use, load);
      return [](Commands&) {};
    });
  }
  void look(ImageRef at, Use use) {
    graph.pass("look", [&](Pass& pass) {
      pass.read(at, use);
      pass.sideEffect();
      return [](Commands&) {};
    });
  }
  const Transition& only(const PlannedBarrier& barrier) {
    EXPECT_EQ(barrier.transitions.count, 1u);
    return implOf(graph).transitions[barrier.transitions.first];
  }
  const PlannedBarrier& last() { return implOf(graph).finalBarrier; }
  std::string after(auto&& declare) {
    graph.reset();
    declare();
    return compileError();
  }
};

TEST_F(ImportStates, SwapchainImageEndsInPresentLayout) {
  draw(image(Use::Unknown, Use::Present), Use::ColorTarget, Load::Discard);
  compile();
  const Transition& first = only(implOf(graph).passes[0].barrier);
  EXPECT_EQ(first.from, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(first.scope.sourceStage, kAll) << "covers any stage at which the submission waits for the image";
  const Transition& present = only(last());
  EXPECT_EQ(present.to, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
  EXPECT_EQ(present.scope, (Scope{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, kAll, 0}));
}

TEST_F(ImportStates, PresentedImageKeepsContent) {
  draw(image(Use::Present, Use::Present), Use::ColorTarget);
  compile();
  EXPECT_EQ(only(implOf(graph).passes[0].barrier).from, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR) << "its content is kept";
  EXPECT_EQ(only(last()).to, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

TEST_F(ImportStates, CustomStatesAreSynchronized) {
  look(image(kSampledInGeneral, kSampledInGeneral), Use::ComputeSampled);
  compile();
  const Transition& first = only(implOf(graph).passes[0].barrier);
  EXPECT_EQ(first.from, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(first.scope.sourceStage, kFragment);
  const Transition& final = only(last());
  EXPECT_EQ(final.to, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(final.scope.targetStage, kFragment);
  EXPECT_EQ(final.scope.targetAccess, kSampled);
}

TEST_F(ImportStates, CustomStateWithEqualLayoutNeedsNoTransition) {
  draw(image(kSampledInGeneral, kSampledInGeneral), Use::ComputeWrite);
  compile();
  EXPECT_EQ(implOf(graph).passes[0].barrier.transitions.count, 0u);
  EXPECT_EQ(barrier(0).sourceStage, kFragment) << "the stage that read it";
  EXPECT_EQ(barrier(0).targetStage, kCompute);
  EXPECT_EQ(last().transitions.count, 0u);
  EXPECT_EQ(last().scope, (Scope{kCompute, kStorageWrite, kFragment, kSampled}));
}

TEST_F(ImportStates, BufferReachesCustomStage) {
  constexpr UseState build{.stages = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, .access = VK_ACCESS_2_SHADER_READ_BIT};
  constexpr UseState written{.stages = kFragment, .access = VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_SHADER_READ_BIT};
  (void)write("write", graph.import("positions", {fakeBuffer(9), 0, 64, written, build}));
  compile();
  EXPECT_EQ(barrier(0).sourceStage, kFragment);
  EXPECT_EQ(barrier(0).sourceAccess, VK_ACCESS_2_SHADER_WRITE_BIT) << "reads need no availability operation";
  EXPECT_EQ(last().scope, (Scope{kCompute, kStorageWrite, build.stages, build.access}));
}

TEST_F(ImportStates, StateWithoutStagesNeedsNoBarrier) {
  draw(image(UseState{.layout = VK_IMAGE_LAYOUT_GENERAL}, Use::Nothing), Use::ComputeWrite);
  (void)graph.import("buffer", {fakeBuffer(9), 0, 64, UseState{}, UseState{}});
  compile();
  EXPECT_TRUE(implOf(graph).passes[0].barrier.empty());
  EXPECT_TRUE(last().empty());
}

TEST_F(ImportStates, VertexInputWaitsForComputeWrite) {
  read("draw", write("make", import("vertices", Use::VertexInput), Use::ComputeWrite, true), Use::VertexInput);
  compile();
  EXPECT_EQ(barrier(0), (Scope{VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT, 0, kCompute, 0}));
  EXPECT_EQ(barrier(1), (Scope{kCompute, kStorageWrite, VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT,
                               VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT}));
}

TEST_F(ImportStates, ChangedCustomStateMakesNewPlan) {
  const auto plan = [&](ImportState state) {
    graph.reset();
    look(image(state, Use::Nothing), Use::ComputeRead);
    compile();
  };
  plan(kSampledInGeneral);
  const uint64_t plans = implOf(graph).plansMade;
  plan(kSampledInGeneral);
  EXPECT_EQ(implOf(graph).plansMade, plans);
  UseState other = kSampledInGeneral;
  other.stages = kTransfer;
  plan(other);
  EXPECT_EQ(implOf(graph).plansMade, plans + 1);
  EXPECT_EQ(barrier(0).sourceStage, kTransfer);
}

TEST_F(ImportStates, UseStateMatchesPlannedBarriers) {
  const UseState sampled = useState(Use::ComputeSampled);
  EXPECT_EQ(sampled, (UseState{kCompute, kSampled, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_SAMPLED_BIT, 0}));
  const UseState write = useState(Use::ComputeWrite);
  EXPECT_EQ(write.access, kStorageRead | kStorageWrite);
  EXPECT_EQ(write.bufferUsage, VkBufferUsageFlags(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
  EXPECT_EQ(useState(Use::Nothing), UseState{});
  // A Use and the equal custom state give the same barrier.
  draw(image(Use::ComputeSampled, Use::Nothing), Use::ComputeWrite);
  compile();
  const Transition named = only(implOf(graph).passes[0].barrier);
  graph.reset();
  draw(image(sampled, Use::Nothing), Use::ComputeWrite);
  compile();
  EXPECT_EQ(only(implOf(graph).passes[0].barrier).scope, named.scope);
}

TEST_F(ImportStates, ErrorsNameTheResource) {
  EXPECT_EQ(after([&] { (void)image(UseState{.stages = kFragment, .access = kSampled}, Use::Nothing); }),
            "import 'image': a custom state of an image needs a layout");
  EXPECT_EQ(after([&] { (void)image(UseState{.access = kSampled, .layout = VK_IMAGE_LAYOUT_GENERAL}, Use::Nothing); }),
            "import 'image': the custom state has accesses but no stages");
  EXPECT_EQ(after([&] { (void)image(Use::Nothing, UseState{.layout = VK_IMAGE_LAYOUT_PREINITIALIZED}); }),
            "import 'image': VK_IMAGE_LAYOUT_PREINITIALIZED is not a valid final layout");
  EXPECT_EQ(after([&] {
              (void)graph.import("buffer", {fakeBuffer(1), 0, 64, kSampledInGeneral});
            }),
            "import 'buffer': a custom state of a buffer must not have a layout");
  EXPECT_EQ(after([&] {
              (void)graph.import("buffer", {fakeBuffer(1), 0, 64, Use::Present});
            }),
            "import 'buffer': Use::Present is not a use of a buffer");
  EXPECT_EQ(after([&] { (void)image(Use::VertexInput, Use::Nothing); }), "import 'image': Use::VertexInput is not a use of an image");
  EXPECT_EQ(after([&] { look(image(Use::Present, Use::Nothing), Use::Present); }),
            "pass 'look' reads 'image' with Use::Present, which is not a read use an image");
  EXPECT_EQ(after([&] { look(image(Use::ComputeRead, Use::Nothing, VK_IMAGE_USAGE_STORAGE_BIT), Use::ComputeSampled); }),
            "pass 'look' uses import 'image' with Use::ComputeSampled, but it was created without VK_IMAGE_USAGE_SAMPLED_BIT");
  EXPECT_EQ(after([&] { draw(image(Use::Unknown, Use::Nothing, VK_IMAGE_USAGE_SAMPLED_BIT), Use::ColorTarget, Load::Discard); }),
            "pass 'draw' uses import 'image' with Use::ColorTarget, but it was created without VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT");
  EXPECT_EQ(after([&] { (void)image(Use::Unknown, Use::CopySource, VK_IMAGE_USAGE_STORAGE_BIT); }),
            "import 'image': Use::CopySource is one of its states, but it was created without VK_IMAGE_USAGE_TRANSFER_SRC_BIT");
  EXPECT_EQ(after([&] { draw(image(Use::Unknown, Use::Present, VK_IMAGE_USAGE_STORAGE_BIT), Use::ComputeWrite); }), "compiled");
  EXPECT_EQ(after([&] {
              (void)graph.create("stencil", ImageDesc{VK_FORMAT_S8_UINT, 8, 8});
            }),
            "image 'stencil': stencil-only formats are not supported");
}

}  // namespace
}  // namespace rill::test
