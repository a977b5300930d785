// Passes with the host's own pipelines on transients, on a real driver with synchronization validation.
#include "gpu/device_impl.hpp"
#include "gpu/device_memory.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace graph_handles_test {

constexpr uint32_t kShotWidth = 100, kShotHeight = 40;
constexpr ImageDesc kDesc{VK_FORMAT_R32_SFLOAT, kShotWidth, kShotHeight};

/// A compute pipeline and a descriptor set of the host's own: image_halve, which reads one image and writes one of half its size.
struct OwnPipeline {
  explicit OwnPipeline(DeviceImpl& device) : d(device) {
    const VkDescriptorSetLayoutBinding bindings[] = {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
                                                     {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
    const VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0, 2, bindings};
    EXPECT_EQ(d.vk.CreateDescriptorSetLayout(d.handle, &setInfo, nullptr, &setLayout), VK_SUCCESS);
    const VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &setLayout, 0, nullptr};
    EXPECT_EQ(d.vk.CreatePipelineLayout(d.handle, &layoutInfo, nullptr, &layout), VK_SUCCESS);
    const auto words = testShader("image_halve");
    const VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, words.size_bytes(), words.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    EXPECT_EQ(d.vk.CreateShaderModule(d.handle, &moduleInfo, nullptr, &module), VK_SUCCESS);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, module, "main", nullptr};
    info.layout = layout;
    EXPECT_EQ(d.vk.CreateComputePipelines(d.handle, VK_NULL_HANDLE, 1, &info, nullptr, &handle), VK_SUCCESS);
    d.vk.DestroyShaderModule(d.handle, module, nullptr);
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1}};
    const VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, 1, 2, sizes};
    EXPECT_EQ(d.vk.CreateDescriptorPool(d.handle, &poolInfo, nullptr, &pool), VK_SUCCESS);
    const VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool, 1, &setLayout};
    EXPECT_EQ(d.vk.AllocateDescriptorSets(d.handle, &allocate, &set), VK_SUCCESS);
  }
  ~OwnPipeline() {
    d.vk.DestroyDescriptorPool(d.handle, pool, nullptr);
    d.vk.DestroyPipeline(d.handle, handle, nullptr);
    d.vk.DestroyPipelineLayout(d.handle, layout, nullptr);
    d.vk.DestroyDescriptorSetLayout(d.handle, setLayout, nullptr);
  }
  OwnPipeline(const OwnPipeline&) = delete;
  OwnPipeline& operator=(const OwnPipeline&) = delete;
  void dispatch(VkCommandBuffer commands, const ImageHandle& from, const ImageHandle& to, uint32_t groups) const {
    const VkDescriptorImageInfo images[] = {{VK_NULL_HANDLE, from.view, from.layout}, {VK_NULL_HANDLE, to.view, to.layout}};
    VkWriteDescriptorSet writes[2] = {{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}, {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}};
    for (uint32_t i = 0; i < 2; ++i) {
      writes[i].dstSet = set;
      writes[i].dstBinding = i;
      writes[i].descriptorCount = 1;
      writes[i].descriptorType = i == 0 ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
      writes[i].pImageInfo = &images[i];
    }
    d.vk.UpdateDescriptorSets(d.handle, 2, writes, 0, nullptr);
    d.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, handle);
    d.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    d.vk.CmdDispatch(commands, groups, 1, 1);
  }
  DeviceImpl& d;
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline handle = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
};

/// An image of the host's own.
struct OwnImage {
  OwnImage(DeviceImpl& device, const ImageDesc& desc, VkImageUsageFlags usage) : d(device) {
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = desc.format;
    create.extent = {desc.width, desc.height, 1};
    create.mipLevels = create.arrayLayers = 1;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = usage;
    EXPECT_EQ(d.vk.CreateImage(d.handle, &create, nullptr, &handle), VK_SUCCESS);
    const VkDeviceImageMemoryRequirements ask{VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS, nullptr, &create,
                                              VK_IMAGE_ASPECT_COLOR_BIT};
    VkMemoryRequirements2 needs{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    d.vk.GetDeviceImageMemoryRequirements(d.handle, &ask, &needs);
    const auto block = allocateMemory(d, needs.memoryRequirements, MemoryKind::Device, {"image of the host's"});
    EXPECT_TRUE(block);
    if (block) memory = *block;
    EXPECT_EQ(d.vk.BindImageMemory(d.handle, handle, memory.memory, memory.offset), VK_SUCCESS);
  }
  ~OwnImage() {
    d.vk.DestroyImage(d.handle, handle, nullptr);
    freeMemory(d, memory);
  }
  OwnImage(const OwnImage&) = delete;
  OwnImage& operator=(const OwnImage&) = delete;
  DeviceImpl& d;
  VkImage handle = VK_NULL_HANDLE;
  MemoryBlock memory;
};

class GraphHandles : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    d = &implOf(device());
  }
  ImageRef fill(Graph& graph, ImageRef image, float base, Load load = Load::Discard) {
    static constexpr BindingKind kinds[] = {BindingKind::StorageImage};
    const ComputePipeline* filler =
        pipeline({.shader = "image_fill", .spirv = testShader("image_fill"), .bindings = kinds, .pushConstantBytes = 4});
    graph.pass("fill", [&](Pass& pass) {
      image = pass.write(image, Use::ComputeWrite, load);
      const Kernel kernel = pass.kernel(filler, {image});
      return [=](Commands& commands) { commands.dispatch(kernel, (kShotWidth * kShotHeight + 63) / 64, base); };
    });
    return image;
  }
  Ticket readback(Graph& graph, ImageRef image) {
    BufferRef bytes = graph.create("texels", {kShotWidth * kShotHeight * 4});
    graph.pass("copy", [&](Pass& pass) {
      pass.read(image, Use::CopySource);
      bytes = pass.write(bytes, Use::CopyTarget);
      return [=](Commands& commands) { commands.copy(image, bytes); };
    });
    return graph.readback(bytes);
  }
  static float filled(float base, uint32_t i) { return base + float(i % kShotWidth) + 1000.0f * float(i / kShotWidth); }

  DeviceImpl* d = nullptr;
};

// Between two passes with Rill's pipelines, to check barriers and bindings on both sides.
TEST_F(GraphHandles, HostPipelineUsesTransients) {
  const OwnPipeline own(*d);
  constexpr uint32_t width = kShotWidth / 2, height = kShotHeight / 2;
  Graph graph;
  const ImageRef full = fill(graph, graph.create("full", kDesc), 3.0f);
  ImageRef half = graph.create("half", ImageDesc{kDesc.format, width, height});
  graph.pass("the host's own", [&](Pass& pass) {
    pass.read(full, Use::ComputeSampled);
    half = pass.write(half, Use::ComputeWrite, Load::Discard);
    return [=, &own](Commands& commands) {
      own.dispatch(commands.handle(), commands.image(full), commands.image(half), (width * height + 63) / 64);
    };
  });
  ImageRef quarter = graph.create("quarter", ImageDesc{kDesc.format, width / 2, height / 2});
  static constexpr BindingKind kinds[] = {BindingKind::SampledImage, BindingKind::StorageImage};
  const ComputePipeline* halve = pipeline({.shader = "image_halve", .spirv = testShader("image_halve"), .bindings = kinds});
  graph.pass("Rill's", [&](Pass& pass) {
    pass.read(half, Use::ComputeSampled);
    quarter = pass.write(quarter, Use::ComputeWrite, Load::Discard);
    const Kernel kernel = pass.kernel(halve, {half, quarter});
    return [=](Commands& commands) { commands.dispatch(kernel, Groups{(width * height / 4 + 63) / 64}); };
  });
  BufferRef bytes = graph.create("texels", {width * height});
  graph.pass("copy", [&](Pass& pass) {
    pass.read(quarter, Use::CopySource);
    bytes = pass.write(bytes, Use::CopyTarget);
    return [=](Commands& commands) { commands.copy(quarter, bytes); };
  });
  const Ticket ticket = graph.readback(bytes);
  run(graph);
  const auto result = read<float>(graph, ticket);
  ASSERT_EQ(result.size(), size_t{width} * height / 4);
  for (uint32_t i = 0; i < result.size(); ++i) {
    const uint32_t x = i % (width / 2) * 4, y = i / (width / 2) * 4;
    ASSERT_EQ(result[i], 16 * (3.0f + float(x) + 1.5f + 1000.0f * (float(y) + 1.5f))) << "texel " << i;
  }
}

TEST_F(GraphHandles, RawCommandsUseTransients) {
  Graph graph;
  ImageRef image = graph.create("image", kDesc);
  BufferRef bytes = graph.create("bytes", {kShotWidth * kShotHeight * 4}), ahead = graph.create("ahead", {256});
  graph.pass("clear", [&](Pass& pass) {
    image = pass.write(image, Use::CopyTarget);
    ahead = pass.write(ahead, Use::CopyTarget);
    return [=, this](Commands& commands) {
      const ImageHandle at = commands.image(image);
      const VkClearColorValue value{{0.5f, 0, 0, 0}};
      const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, at.level, 1, 0, 1};
      d->vk.CmdClearColorImage(commands.handle(), at.image, at.layout, &value, 1, &whole);
      commands.fill(ahead, 1);
    };
  });
  graph.pass("copy", [&](Pass& pass) {
    pass.read(image, Use::CopySource);
    pass.read(ahead, Use::CopySource);
    bytes = pass.write(bytes, Use::CopyTarget);
    return [=, this](Commands& commands) {
      const ImageHandle from = commands.image(image);
      const VkDescriptorBufferInfo to = commands.buffer(bytes);
      const VkBufferImageCopy region{to.offset, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, from.level, 0, 1}, {}, {kShotWidth, kShotHeight, 1}};
      d->vk.CmdCopyImageToBuffer(commands.handle(), from.image, from.layout, to.buffer, 1, &region);
    };
  });
  const Ticket ticket = graph.readback(bytes), other = graph.readback(ahead);
  run(graph);
  EXPECT_EQ(read<float>(graph, ticket), std::vector<float>(kShotWidth * kShotHeight, 0.5f));
  EXPECT_EQ(read<uint32_t>(graph, other), std::vector<uint32_t>(64, 1u)) << "no byte of another transient was touched";
}

TEST_F(GraphHandles, CopiesImageToImage) {
  Graph graph;
  const ImageRef first = fill(graph, graph.create("first", kDesc), 7.0f);
  ImageRef second = graph.create("second", kDesc);
  graph.pass("copy over", [&](Pass& pass) {
    pass.read(first, Use::CopySource);
    second = pass.write(second, Use::CopyTarget);
    return [=](Commands& commands) { commands.copy(first, second); };
  });
  const Ticket ticket = readback(graph, second);
  run(graph);
  const auto result = read<float>(graph, ticket);
  ASSERT_EQ(result.size(), size_t{kShotWidth} * kShotHeight);
  for (uint32_t i = 0; i < result.size(); ++i) ASSERT_EQ(result[i], filled(7.0f, i)) << "texel " << i;
}

// One frame leaves an image in a state that no pass has and the next one continues from there.
TEST_F(GraphHandles, ImportsKeepContentInCustomStates) {
  const VkImageUsageFlags usage = useState(Use::ComputeWrite).imageUsage | useState(Use::CopySource).imageUsage;
  const OwnImage image(*d, kDesc, usage);
  const UseState transfer{
      .stages = VK_PIPELINE_STAGE_2_COPY_BIT, .access = VK_ACCESS_2_TRANSFER_READ_BIT, .layout = VK_IMAGE_LAYOUT_GENERAL};
  float base = 1;
  for (const ImportState& state : {ImportState(Use::Present), ImportState(transfer)}) {
    base += 10;
    Graph graph;
    const ImageImport first{image.handle, kDesc, Use::Unknown, state, usage}, second{image.handle, kDesc, state, Use::Nothing, usage};
    (void)fill(graph, graph.import("image", first), base);
    run(graph);
    graph.reset();
    const Ticket ticket = readback(graph, graph.import("image", second));
    run(graph);
    const auto result = read<float>(graph, ticket);
    ASSERT_EQ(result.size(), size_t{kShotWidth} * kShotHeight);
    for (uint32_t i = 0; i < result.size(); ++i) ASSERT_EQ(result[i], filled(base, i)) << "texel " << i;
    ASSERT_TRUE(context().wait());
  }
}

}  // namespace graph_handles_test
}  // namespace rill::test
