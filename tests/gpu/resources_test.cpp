// Buffers, pipelines and the offline context.
#include <bit>

#include "gpu/device_impl.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace resources_test {

using Resources = GpuTest;
constexpr BindingKind kOneBuffer[] = {BindingKind::Storage};

TEST_F(Resources, BufferMemoryMatchesKind) {
  const Buffer local = buffer("local", 1000), up = buffer("up", 1000, MemoryKind::Upload),
               back = buffer("back", 1000, MemoryKind::Readback);
  EXPECT_EQ(local.mapped(), nullptr);
  ASSERT_NE(up.mapped(), nullptr);
  ASSERT_NE(back.mapped(), nullptr);
  EXPECT_EQ(up.size(), 1000u);
}

TEST_F(Resources, RejectsInvalidSizes) {
  for (const uint64_t size : std::initializer_list<uint64_t>{0, device().info().maxBufferBytes + 1, UINT64_MAX}) {
    const auto made = createBuffer(device(), "positions", size);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().kind, ErrorKind::BadInput);
    EXPECT_NE(made.error().message.find("'positions'"), std::string::npos) << made.error().message;
  }
}

TEST_F(Resources, BufferOutlivesRecordingFrame) {
  ASSERT_TRUE(context().wait());
  const size_t before = implOf(device()).retired.size();
  auto clock = context().beginFrame();
  ASSERT_TRUE(clock);
  { const Buffer shortLived = buffer("short-lived", 64); }
  EXPECT_EQ(implOf(device()).retired.size(), before + 2);
  device().beginFrame(*clock);
  EXPECT_EQ(implOf(device()).retired.size(), before + 2) << "its frame is still being recorded";
  ASSERT_TRUE(context().submit([](VkCommandBuffer) {}));
  ASSERT_TRUE(context().wait());
  EXPECT_EQ(implOf(device()).retired.size(), 0u);
}

TEST_F(Resources, EqualDescriptionsShareOnePipeline) {
  const uint32_t one[] = {1}, two[] = {2};
  const auto make = [&](std::span<const uint32_t> constants) {
    return pipeline({.shader = "subgroup", .spirv = testShader("subgroup"), .bindings = kOneBuffer, .constants = constants});
  };
  const auto* first = make(one);
  const size_t count = pipelineCount(device());
  EXPECT_EQ(make(one), first);
  EXPECT_EQ(pipelineCount(device()), count);
  EXPECT_NE(make(two), first);
  EXPECT_EQ(pipelineCount(device()), count + 1);
}

TEST_F(Resources, AppliesConstantsAndSubgroupSize) {
  const DeviceInfo& info = device().info();
  const uint32_t constants[] = {42, std::bit_cast<uint32_t>(2.5f)};
  for (uint32_t size = info.minSubgroupSize; size <= std::min(info.maxSubgroupSize, 64u); size *= 2) {
    Graph graph;
    BufferRef out = graph.create("out", {12});
    graph.pass("subgroup", [&](Pass& pass) {
      out = pass.write(out, Use::ComputeWrite);
      const Kernel kernel = pass.kernel(pipeline({.shader = "subgroup",
                                                  .spirv = testShader("subgroup"),
                                                  .bindings = kOneBuffer,
                                                  .constants = constants,
                                                  .requiredSubgroupSize = size}),
                                        {out});
      return [=](Commands& commands) { commands.dispatch(kernel, 1); };
    });
    const Ticket ticket = graph.readback(out);
    run(graph);
    EXPECT_EQ(read<uint32_t>(graph, ticket), (std::vector<uint32_t>{size, 42, 10}));
  }
}

TEST_F(Resources, ErrorsNameTheShader) {
  const auto unknown = computePipeline(device(), {.shader = "fluid/nonsense", .bindings = kOneBuffer});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::Shader);
  EXPECT_NE(unknown.error().message.find("fluid/nonsense"), std::string::npos);
  const uint32_t tooLarge = device().info().maxSubgroupSize * 2;
  const auto sized = computePipeline(
      device(), {.shader = "subgroup", .spirv = testShader("subgroup"), .bindings = kOneBuffer, .requiredSubgroupSize = tooLarge});
  ASSERT_FALSE(sized);
  EXPECT_NE(sized.error().message.find("subgroups of " + std::to_string(tooLarge)), std::string::npos) << sized.error().message;
}

TEST_F(Resources, SelectsDeviceByNameAndIndex) {
  const auto byIndex = offline::Context::create({.device = "0"});
  ASSERT_TRUE(byIndex) << byIndex.error().message;
  const std::string name = byIndex->device().info().name;
  const auto byName = offline::Context::create({.device = name.substr(0, 5)});
  ASSERT_TRUE(byName) << byName.error().message;
  EXPECT_EQ(byName->device().info().name, name);
  const auto none = offline::Context::create({.device = "Voodoo 2"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::BadInput);
  EXPECT_NE(none.error().message.find("0  " + name), std::string::npos) << none.error().message;
}

TEST_F(Resources, BorrowNamesMissingInput) {
  HostDevice host;
  host.instance = context().instance();
  host.physicalDevice = context().physicalDevice();
  host.device = context().vkDevice();
  host.queueFamily = context().queueFamily();
  host.getInstanceProcAddr = context().getInstanceProcAddr();
  auto refused = Device::borrow(host);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("enabled"), std::string::npos);

  DeviceRequirements needs;
  ASSERT_TRUE(appendRequired(host.getInstanceProcAddr, host.instance, host.physicalDevice, needs));
  host.enabled = needs.chain();
  EXPECT_TRUE(Device::borrow(host));
  needs.vulkan13.synchronization2 = VK_FALSE;
  refused = Device::borrow(host);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::NoDevice);
  EXPECT_NE(refused.error().message.find("synchronization2"), std::string::npos) << refused.error().message;
}

}  // namespace resources_test
}  // namespace rill::test
