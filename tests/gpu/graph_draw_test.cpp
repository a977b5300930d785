// Drawing through the graph on a real driver, with synchronization validation.
#include "gpu/device_impl.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace graph_draw_test {

constexpr uint32_t kWidth = 64, kHeight = 48;
constexpr ImageDesc kColor{VK_FORMAT_R32_SFLOAT, kWidth, kHeight}, kDepth{VK_FORMAT_D32_SFLOAT, kWidth, kHeight};

struct DrawPush {
  float rect[4];
  float depth, value;
};

class GraphDraw : public GpuTest {
 protected:
  const GraphicsPipeline* drawing(VkCompareOp compare) {
    static constexpr BindingKind kinds[] = {BindingKind::Storage};
    auto made = graphicsPipeline(device(), {.vertex = "draw_vertex",
                                            .fragment = "draw_fragment",
                                            .vertexSpirv = testShader("draw_vertex"),
                                            .fragmentSpirv = testShader("draw_fragment"),
                                            .bindings = kinds,
                                            .pushConstantBytes = sizeof(DrawPush),
                                            .colors = {&kColor.format, 1},
                                            .depth = kDepth.format,
                                            .depthCompare = compare,
                                            .depthWrite = true,
                                            .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP});
    EXPECT_TRUE(made) << made.error().message;
    return made ? *made : nullptr;
  }
  /// Several frames of one graph in one command buffer, so that synchronization validation covers all.
  template <class Declare>
  void runFrames(Graph& graph, int count, Declare&& declare) {
    auto submitted = context().submit([&](VkCommandBuffer commandBuffer) {
      for (int frame = 0; frame < count; ++frame) {
        graph.reset();
        declare(frame);
        auto ok = graph.compile();
        if (ok) ok = graph.prepare(device());
        ASSERT_TRUE(ok) << ok.error().message;
        graph.record(commandBuffer);
      }
    });
    ASSERT_TRUE(submitted);
    ASSERT_TRUE(context().wait());
  }
  Ticket readback(Graph& graph, ImageRef image, uint32_t width, uint32_t height) {
    BufferRef bytes = graph.create("texels", {uint64_t{width} * height * 4});
    graph.pass("copy", [&](Pass& pass) {
      pass.read(image, Use::CopySource);
      bytes = pass.write(bytes, Use::CopyTarget);
      return [=](Commands& commands) { commands.copy(image, bytes); };
    });
    return graph.readback(bytes);
  }
};

// A far rectangle over everything, a near one over the right half, and one in between; then a second pass with
// Load::Keep and indirect arguments. Three frames in one command buffer.
TEST_F(GraphDraw, DepthTestAndLoadKeepCompose) {
  const GraphicsPipeline* less = drawing(VK_COMPARE_OP_LESS);
  ASSERT_TRUE(less);
  std::vector<float> addedHere(kWidth);
  for (uint32_t x = 0; x < kWidth; ++x) addedHere[x] = float(x) / 256;
  const Buffer addedBuffer = upload("added", addedHere);
  const Buffer arguments = upload("arguments", std::vector<uint32_t>{0, 0, 0, 0, 4, 1, 0, 0});
  Graph graph;
  Ticket tickets[3], depths[3];
  runFrames(graph, 3, [&](int frame) {
    const BufferRef added = graph.import("added", importOf(addedBuffer)), indirect = graph.import("arguments", importOf(arguments));
    ImageRef color = graph.create("color", kColor), depth = graph.create("depth", kDepth);
    graph.pass("draw", [&](Pass& pass) {
      pass.read(added, Use::DrawRead);
      VkClearValue far{};
      far.depthStencil = {1, 0};
      color = pass.write(color, Use::ColorTarget, Load::Discard);
      depth = pass.write(depth, Use::DepthTarget, Load::Clear, far);
      const Kernel kernel = pass.kernel(less, {added});
      return [=](Commands& commands) {
        commands.draw(kernel, 4, 1, DrawPush{{-1, -1, 1, 1}, 0.75f, 1.0f + float(frame)});
        commands.draw(kernel, 4, 1, DrawPush{{0, -1, 1, 1}, 0.25f, 10.0f});
        commands.draw(kernel, 4, 1, DrawPush{{-1, -1, 1, 1}, 0.5f, 100.0f});
      };
    });
    graph.pass("over", [&](Pass& pass) {
      pass.read(added, Use::DrawRead);
      pass.read(indirect, Use::Indirect);
      color = pass.write(color, Use::ColorTarget);
      depth = pass.write(depth, Use::DepthTarget);
      const Kernel kernel = pass.kernel(less, {added});
      return [=](Commands& commands) {
        commands.viewport(0, 0, kWidth, kHeight / 2);
        commands.drawIndirect(kernel, indirect, 16, DrawPush{{-1, -1, 1, 1}, 0.375f, 1000.0f});
      };
    });
    tickets[frame] = readback(graph, color, kWidth, kHeight);
    depths[frame] = readback(graph, depth, kWidth, kHeight);
  });
  for (int frame = 0; frame < 3; ++frame) {
    const auto color = read<float>(graph, tickets[frame]), depth = read<float>(graph, depths[frame]);
    ASSERT_EQ(color.size(), size_t{kWidth} * kHeight);
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const bool right = x >= kWidth / 2, upper = y < kHeight / 2;
        const float value = right ? 10.0f : upper ? 1000.0f : 100.0f;
        EXPECT_EQ(color[y * kWidth + x], value + addedHere[x]) << x << " " << y;
        EXPECT_NEAR(depth[y * kWidth + x], right ? 0.25f : upper ? 0.375f : 0.5f, 1e-6);
      }
  }
}

TEST_F(GraphDraw, ReadsMipLevelsOneByOne) {
  static constexpr BindingKind kFill[] = {BindingKind::StorageImage}, kHalve[] = {BindingKind::SampledImage, BindingKind::StorageImage};
  const ComputePipeline* fill =
      pipeline({.shader = "image_fill", .spirv = testShader("image_fill"), .bindings = kFill, .pushConstantBytes = 4});
  const ComputePipeline* halve = pipeline({.shader = "image_halve", .spirv = testShader("image_halve"), .bindings = kHalve});
  Graph graph;
  Ticket tickets[2];
  runFrames(graph, 2, [&](int frame) {
    const ImageRef pyramid = graph.create("pyramid", {VK_FORMAT_R32_SFLOAT, kWidth, kHeight, 4});
    ImageRef level = graph.level(pyramid, 0);
    graph.pass("fill", [&](Pass& pass) {
      level = pass.write(level, Use::ComputeWrite, Load::Discard);
      const Kernel kernel = pass.kernel(fill, {level});
      return [=](Commands& commands) { commands.dispatch(kernel, kWidth * kHeight / 64, float(frame)); };
    });
    for (uint32_t k = 1; k < 4; ++k)
      graph.pass("halve", [&](Pass& pass) {
        pass.read(level, Use::ComputeSampled);
        const ImageRef next = pass.write(graph.level(pyramid, k), Use::ComputeWrite, Load::Discard);
        const Kernel kernel = pass.kernel(halve, {level, next});
        level = next;
        return [=](Commands& commands) { commands.dispatch(kernel, ((kWidth >> k) * (kHeight >> k) + 63) / 64); };
      });
    tickets[frame] = readback(graph, level, kWidth / 8, kHeight / 8);
  });
  for (int frame = 0; frame < 2; ++frame) {
    const auto sums = read<float>(graph, tickets[frame]);
    ASSERT_EQ(sums.size(), size_t{kWidth / 8} * (kHeight / 8));
    for (uint32_t i = 0; i < sums.size(); ++i) {
      // 64 texels, each frame + x + 1000 y.
      const double x = 8.0 * (i % (kWidth / 8)) + 3.5, y = 8.0 * (i / (kWidth / 8)) + 3.5;
      EXPECT_FLOAT_EQ(sums[i], float(64 * (frame + x + 1000 * y)));
    }
  }
}

// Read-backs that together exceed the largest buffer.
TEST_F(GraphDraw, ReadbacksSpanSeveralBuffers) {
  constexpr uint64_t kBytes = 80ull << 20;
  Graph graph;
  BufferRef buffers[2] = {graph.create("one", {kBytes}), graph.create("two", {kBytes})};
  Ticket tickets[2];
  for (uint32_t k = 0; k < 2; ++k)
    graph.pass("fill", [&](Pass& pass) {
      buffers[k] = pass.write(buffers[k], Use::CopyTarget, true);
      return [buffer = buffers[k], k](Commands& commands) { commands.fill(buffer, 7 + k); };
    });
  for (uint32_t k = 0; k < 2; ++k) tickets[k] = graph.readback(buffers[k]);
  run(graph);
  for (uint32_t k = 0; k < 2; ++k) {
    const auto words = read<uint32_t>(graph, tickets[k]);
    ASSERT_EQ(words.size(), kBytes / 4);
    EXPECT_EQ(words.front(), 7 + k);
    EXPECT_EQ(words.back(), 7 + k);
  }
}

}  // namespace graph_draw_test
}  // namespace rill::test
