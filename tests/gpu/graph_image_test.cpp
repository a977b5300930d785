// Images on a real driver, with synchronization validation.
#include <cmath>
#include <numeric>

#include "gpu/device_impl.hpp"
#include "gpu/device_memory.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace graph_image_test {

constexpr uint32_t kWidth = 100, kHeight = 40;
constexpr ImageDesc kDesc{VK_FORMAT_R32_SFLOAT, kWidth, kHeight};

class GraphImages : public GpuTest {
 protected:
  ImageRef fill(Graph& graph, ImageRef image, float base) {
    static constexpr BindingKind kinds[] = {BindingKind::StorageImage};
    const ComputePipeline* filler =
        pipeline({.shader = "image_fill", .spirv = testShader("image_fill"), .bindings = kinds, .pushConstantBytes = 4});
    graph.pass("fill", [&](Pass& pass) {
      image = pass.write(image, Use::ComputeWrite, Load::Discard);
      const Kernel kernel = pass.kernel(filler, {image});
      return [=](Commands& commands) { commands.dispatch(kernel, (kWidth * kHeight + 63) / 64, base); };
    });
    return image;
  }
  ImageRef add(Graph& graph, ImageRef source, ImageRef own) {
    static constexpr BindingKind kinds[] = {BindingKind::SampledImage, BindingKind::StorageImage, BindingKind::StorageImage};
    const ComputePipeline* adder = pipeline({.shader = "image_add", .spirv = testShader("image_add"), .bindings = kinds});
    ImageRef sum = graph.create("sum", kDesc);
    graph.pass("add", [&](Pass& pass) {
      pass.read(source, Use::ComputeSampled);
      pass.read(own, Use::ComputeRead);
      sum = pass.write(sum, Use::ComputeWrite);
      const Kernel kernel = pass.kernel(adder, {source, own, sum});
      return [=](Commands& commands) { commands.dispatch(kernel, (kWidth * kHeight + 63) / 64); };
    });
    return sum;
  }
  Ticket readback(Graph& graph, ImageRef image) {
    BufferRef bytes = graph.create("texels", {kWidth * kHeight * 4});
    graph.pass("copy", [&](Pass& pass) {
      pass.read(image, Use::CopySource);
      bytes = pass.write(bytes, Use::CopyTarget);
      return [=](Commands& commands) { commands.copy(image, bytes); };
    });
    return graph.readback(bytes);
  }
  static float filled(float base, uint32_t x, uint32_t y) { return base + float(x) + 1000.0f * float(y); }
};

// Twenty images with at most three live at a time, in three frames of one command buffer: later images must
// wait for earlier users of their memory, in this frame and the previous one.
TEST_F(GraphImages, AliasSafelyAcrossFrames) {
  Graph graph;
  Ticket tickets[3];
  auto submitted = context().submit([&](VkCommandBuffer commandBuffer) {
    for (int frame = 0; frame < 3; ++frame) {
      graph.reset();
      ImageRef own = fill(graph, graph.create("own", kDesc), 1.0f);
      ImageRef sum = fill(graph, graph.create("first", kDesc), float(10 * frame));
      for (int i = 0; i < 20; ++i) sum = add(graph, sum, own);
      tickets[frame] = readback(graph, sum);
      auto ok = graph.compile();
      if (ok) ok = graph.prepare(device());
      ASSERT_TRUE(ok) << ok.error().message;
      EXPECT_LT(graph.transientBytes(), 8u * kWidth * kHeight * 4) << "three of 22 images, the buffer, padding and alignment";
      graph.record(commandBuffer);
    }
  });
  ASSERT_TRUE(submitted);
  ASSERT_TRUE(context().wait());
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<float> expected(kWidth * kHeight), next(kWidth * kHeight);
    for (uint32_t i = 0; i < expected.size(); ++i) expected[i] = filled(float(10 * frame), i % kWidth, i / kWidth);
    for (int step = 0; step < 20; ++step) {
      for (uint32_t i = 0; i < next.size(); ++i)
        next[i] = expected[i % kWidth + 1 < kWidth ? i + 1 : i] + filled(1.0f, i % kWidth, i / kWidth);
      std::swap(expected, next);
    }
    const auto result = read<float>(graph, tickets[frame]);
    ASSERT_EQ(result.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(result[i], expected[i]) << "frame " << frame << ", texel " << i;
  }
}

TEST_F(GraphImages, AreCopiedAndCleared) {
  std::vector<float> numbers(kWidth * kHeight);
  std::iota(numbers.begin(), numbers.end(), 0.0f);
  const Buffer source = upload("source", numbers);
  Graph graph;
  const BufferRef in = graph.import("source", importOf(source));
  ImageRef copied = graph.create("copied", kDesc), cleared = graph.create("cleared", kDesc);
  graph.pass("upload", [&](Pass& pass) {
    pass.read(in, Use::CopySource);
    copied = pass.write(copied, Use::CopyTarget);
    cleared = pass.write(cleared, Use::CopyTarget);
    return [=](Commands& commands) {
      commands.copy(in, copied);
      commands.clear(cleared, {{0.25f, 0, 0, 0}});
    };
  });
  const Ticket first = readback(graph, copied), second = readback(graph, cleared);
  run(graph);
  EXPECT_EQ(read<float>(graph, first), numbers);
  EXPECT_EQ(read<float>(graph, second), std::vector<float>(kWidth * kHeight, 0.25f));
}

TEST_F(GraphImages, ImportsKeepContentBetweenFrames) {
  DeviceImpl& d = implOf(device());
  VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  create.imageType = VK_IMAGE_TYPE_2D;
  create.format = kDesc.format;
  create.extent = {kWidth, kHeight, 1};
  create.mipLevels = create.arrayLayers = 1;
  create.samples = VK_SAMPLE_COUNT_1_BIT;
  create.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  VkImage image = VK_NULL_HANDLE;
  ASSERT_EQ(d.vk.CreateImage(d.handle, &create, nullptr, &image), VK_SUCCESS);
  const VkDeviceImageMemoryRequirements ask{VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS, nullptr, &create,
                                            VK_IMAGE_ASPECT_COLOR_BIT};
  VkMemoryRequirements2 needs{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  d.vk.GetDeviceImageMemoryRequirements(d.handle, &ask, &needs);
  const auto memory = allocateMemory(d, needs.memoryRequirements, MemoryKind::Device, {"image 'target'"});
  ASSERT_TRUE(memory) << memory.error().message;
  ASSERT_EQ(d.vk.BindImageMemory(d.handle, image, memory->memory, memory->offset), VK_SUCCESS);
  {
    Graph graph;
    (void)fill(graph, graph.import("target", {image, kDesc, Use::Unknown, Use::ComputeSampled}), 5.0f);
    run(graph);
    graph.reset();  // the image keeps the last frame's content and layout
    const ImageRef kept = graph.import("target", {image, kDesc, Use::ComputeSampled, Use::Nothing});
    const ImageRef own = fill(graph, graph.create("own", kDesc), 0.0f);
    const Ticket ticket = readback(graph, add(graph, kept, own));
    run(graph);
    const auto result = read<float>(graph, ticket);
    ASSERT_EQ(result.size(), size_t{kWidth} * kHeight);
    EXPECT_EQ(result[kWidth + 3], filled(5.0f, 4, 1) + filled(0.0f, 3, 1));
  }
  ASSERT_TRUE(context().wait());
  d.vk.DestroyImage(d.handle, image, nullptr);
  freeMemory(d, *memory);
}

TEST_F(GraphImages, RejectsUnsupportedFormatByName) {
  Graph graph;
  ImageRef image = graph.create("odd", ImageDesc{VK_FORMAT_R8G8B8_SSCALED, 8, 8});
  graph.pass("draw", [&](Pass& pass) {
    image = pass.write(image, Use::ComputeWrite);
    pass.sideEffect();
    return [](Commands&) {};
  });
  ASSERT_TRUE(graph.compile());
  ASSERT_TRUE(context().beginFrame());
  const auto ok = graph.prepare(device());
  ASSERT_FALSE(ok);
  EXPECT_EQ(ok.error().kind, ErrorKind::BadInput);
  EXPECT_NE(ok.error().message.find("image 'odd' of 8 x 8 texels"), std::string::npos) << ok.error().message;
  EXPECT_NE(ok.error().message.find("does not support storage images of this format"), std::string::npos) << ok.error().message;
  ASSERT_TRUE(context().submit([](VkCommandBuffer) {}));
}

// Proves that validation is active: the image is used in a layout that was not declared.
TEST_F(GraphImages, ValidationReportsHazards) {
  Graph graph;
  ImageRef image = fill(graph, graph.create("image", kDesc), 0.0f);
  BufferRef bytes = graph.create("texels", {kWidth * kHeight * 4});
  graph.pass("copy without saying so", [&](Pass& pass) {
    pass.read(image, Use::ComputeSampled);
    bytes = pass.write(bytes, Use::CopyTarget);
    return [=](Commands& commands) { commands.copy(image, bytes); };
  });
  (void)graph.readback(bytes);
  run(graph);
  EXPECT_FALSE(context().takeMessages().empty());
}

}  // namespace graph_image_test
}  // namespace rill::test
