// Render targets and mip levels.
#include "graph_fixture.hpp"

namespace rill::test {
namespace {

constexpr ImageDesc kColor{VK_FORMAT_R16G16B16A16_SFLOAT, 64, 32}, kDepth{VK_FORMAT_D32_SFLOAT, 64, 32};

class Targets : public GraphTest {
 protected:
  void draw(std::string_view name, ImageRef& color, ImageRef& depth, Load load) {
    graph.pass(name, [&](Pass& p) {
      color = p.write(color, Use::ColorTarget, load);
      depth = p.write(depth, Use::DepthTarget, load);
      return [](Commands&) {};
    });
  }
  void look(std::string_view name, ImageRef image, Use use = Use::ComputeSampled) {
    graph.pass(name, [&](Pass& p) {
      p.read(image, use);
      p.sideEffect();
      return [](Commands&) {};
    });
  }
  const Target& target(size_t pass, uint32_t n) { return implOf(graph).targets[implOf(graph).passes[pass].targets.first + n]; }
  template <class Declare>
  std::string after(Declare&& declare) {
    graph.reset();
    declare();
    return compileError();
  }
};

TEST_F(Targets, StoresOnlyTargetsUsedLater) {
  ImageRef color = graph.create("color", kColor), depth = graph.create("depth", kDepth);
  draw("opaque", color, depth, Load::Clear);
  draw("more", color, depth, Load::Keep);
  look("look", color);
  compile();
  EXPECT_EQ(target(0, 0).load, Load::Clear);
  EXPECT_TRUE(target(0, 0).store) << "the second pass keeps it";
  EXPECT_TRUE(target(0, 1).store);
  EXPECT_TRUE(target(1, 0).store);
  EXPECT_FALSE(target(1, 1).store) << "nothing reads the depth afterwards";
}

TEST_F(Targets, DoesNotStoreTargetsDiscardedLater) {
  ImageRef color = graph.create("color", kColor), depth = graph.create("depth", kDepth);
  draw("opaque", color, depth, Load::Clear);
  look("look", color);
  draw("again", color, depth, Load::Discard);
  look("look again", color);
  look("depth", depth);
  compile();
  EXPECT_FALSE(target(0, 1).store);
  EXPECT_TRUE(target(0, 0).store);
}

TEST_F(Targets, UseAttachmentLayoutsAndStages) {
  ImageRef color = graph.create("color", kColor), depth = graph.create("depth", kDepth);
  draw("draw", color, depth, Load::Clear);
  look("look", depth, Use::DrawSampled);
  compile();
  const PlannedBarrier& first = implOf(graph).passes[0].barrier;
  ASSERT_EQ(first.transitions.count, 2u);
  EXPECT_EQ(implOf(graph).transitions[first.transitions.first].to, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(implOf(graph).transitions[first.transitions.first + 1].to, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
  const PlannedBarrier& second = implOf(graph).passes[1].barrier;
  ASSERT_EQ(second.transitions.count, 1u);
  const Scope scope = implOf(graph).transitions[second.transitions.first].scope;
  EXPECT_EQ(scope.sourceStage, VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT);
  EXPECT_EQ(scope.targetStage, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
}

TEST_F(Targets, ComputeFramesUseNoGraphicsStages) {
  const BufferRef made = write("make", graph.create("buffer", {256}));
  read("use", made);
  compile();
  constexpr VkPipelineStageFlags2 graphics =
      VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  EXPECT_EQ(barrier(0).sourceStage & graphics, 0u) << "the queue may have none";
}

TEST_F(Targets, MipLevelIsReadWhileNextIsWritten) {
  const ImageRef pyramid = graph.create("pyramid", {VK_FORMAT_R32_SFLOAT, 40, 20, 3});
  ImageRef levels[3];
  for (uint32_t k = 0; k < 3; ++k) levels[k] = graph.level(pyramid, k);
  graph.pass("fill", [&](Pass& p) {
    levels[0] = p.write(levels[0], Use::ComputeWrite, Load::Discard);
    return [](Commands&) {};
  });
  for (uint32_t k = 1; k < 3; ++k)
    graph.pass("halve", [&](Pass& p) {
      p.read(levels[k - 1], Use::ComputeSampled);
      levels[k] = p.write(levels[k], Use::ComputeWrite, Load::Discard);
      return [](Commands&) {};
    });
  look("look", levels[2]);
  look("look at the first", levels[0]);
  compile();
  const auto& plan = implOf(graph).plans[1];
  ASSERT_EQ(plan.placements.size(), 1u) << "one image, one placement";
  EXPECT_EQ(plan.placements[0].first, 0u);
  EXPECT_EQ(plan.placements[0].last, 4u);
  for (uint32_t pass = 1; pass < 3; ++pass) {
    const PlannedBarrier& barrier = implOf(graph).passes[pass].barrier;
    ASSERT_EQ(barrier.transitions.count, 2u);
    EXPECT_EQ(implOf(graph).resources[implOf(graph).transitions[barrier.transitions.first].resource].level, pass - 1);
    EXPECT_EQ(implOf(graph).resources[implOf(graph).transitions[barrier.transitions.first + 1].resource].level, pass);
  }
  EXPECT_EQ(implOf(graph).passes[4].barrier.transitions.count, 0u) << "still in the layout that the second pass used";
  EXPECT_EQ(implOf(graph).resources[levels[2].index].width(), 10u);
  EXPECT_EQ(implOf(graph).resources[levels[2].index].height(), 5u);
}

TEST_F(Targets, UnreadMipLevelIsCulled) {
  const ImageRef pyramid = graph.create("pyramid", {VK_FORMAT_R32_SFLOAT, 8, 8, 2});
  ImageRef first = graph.level(pyramid, 0), second = graph.level(pyramid, 1);
  graph.pass("first", [&](Pass& p) {
    first = p.write(first, Use::ComputeWrite, Load::Discard);
    return [](Commands&) {};
  });
  graph.pass("second", [&](Pass& p) {
    second = p.write(second, Use::ComputeWrite, Load::Discard);
    return [](Commands&) {};
  });
  look("look", second);
  compile();
  EXPECT_FALSE(alive(0));
  EXPECT_TRUE(alive(1));
}

TEST_F(Targets, ErrorsNameTheResource) {
  EXPECT_EQ(after([&] {
              ImageRef color = graph.create("color", kColor), depth = graph.create("depth", kDepth);
              draw("draw", color, depth, Load::Keep);
            }),
            "pass 'draw' draws to 'color' with Load::Keep, but its content is undefined; use Load::Clear or Load::Discard");
  EXPECT_EQ(after([&] {
              ImageRef color = graph.create("color", kColor), depth = graph.create("depth", ImageDesc{VK_FORMAT_D32_SFLOAT, 64, 64});
              draw("draw", color, depth, Load::Clear);
            }),
            "pass 'draw' draws to 'depth' and to 'color', which has a different size");
  EXPECT_EQ(after([&] {
              ImageRef color = graph.create("color", kColor), depth = graph.create("depth", kColor);
              draw("draw", color, depth, Load::Clear);
            }),
            "pass 'draw' draws to 'depth' with Use::DepthTarget, but its format has no depth aspect");
  EXPECT_EQ(after([&] {
              graph.pass("draw", [&](Pass& p) {
                (void)p.write(graph.create("image", kColor), Use::ComputeWrite, Load::Clear);
                return [](Commands&) {};
              });
            }),
            "pass 'draw' writes 'image' with Use::ComputeWrite and Load::Clear; only targets can be cleared");
  EXPECT_EQ(after([&] { (void)write("draw", graph.create("buffer", {256}), Use::ColorTarget); }),
            "pass 'draw' writes 'buffer' with Use::ColorTarget, which is not a write use");
  EXPECT_EQ(after([&] { (void)graph.level(graph.create("image", kColor), 1); }), "level 1 of image 'image' requested, but it has 1");
  EXPECT_EQ(after([&] {
              (void)graph.create("image", ImageDesc{VK_FORMAT_R32_SFLOAT, 4, 4, 4});
            }),
            "image 'image' has 4 levels; expected 1 to 3");
  SetLayout set;
  GraphicsPipeline pipeline;
  pipeline.shader = "fake";
  pipeline.set = &set;
  pipeline.bindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  pipeline.colors = {VK_FORMAT_R8G8B8A8_UNORM};
  EXPECT_EQ(after([&] {
              graph.pass("draw", [&](Pass& p) {
                (void)p.write(graph.create("image", kColor), Use::ColorTarget, Load::Clear);
                (void)p.kernel(&pipeline, {});
                return [](Commands&) {};
              });
            }),
            "pass 'draw', shader 'fake': its target formats differ from the targets of the pass");
}

}  // namespace
}  // namespace rill::test
