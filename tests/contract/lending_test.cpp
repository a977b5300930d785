// Requirements for a host, and the errors if they are not met.
#include <cstddef>
#include <cstring>

#include "contract/fixture.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill::test {
namespace {

struct Feature {
  const char* name;
  VkBool32 VkPhysicalDeviceVulkan13Features::*flag;
};
constexpr Feature kFeatures[] = {
    {"synchronization2", &VkPhysicalDeviceVulkan13Features::synchronization2},
    {"dynamicRendering", &VkPhysicalDeviceVulkan13Features::dynamicRendering},
    {"maintenance4", &VkPhysicalDeviceVulkan13Features::maintenance4},
    {"subgroupSizeControl", &VkPhysicalDeviceVulkan13Features::subgroupSizeControl},
    {"computeFullSubgroups", &VkPhysicalDeviceVulkan13Features::computeFullSubgroups},
};

void expectRefused(const HostDevice& hostDevice, ErrorKind kind, std::string_view part) {
  const auto refused = Device::borrow(hostDevice);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, kind);
  EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
}

TEST_F(Contract, RunsWithRequiredFeaturesAndNoExtensions) {
  auto made = client();
  ASSERT_TRUE(made);
  frames(*made, 3);
  EXPECT_FALSE(made->readback().empty());
}

TEST_F(Contract, RequiresExactlyTheseFeatures) {
  DeviceRequirements all;
  for (const Feature& feature : kFeatures) all.vulkan13.*feature.flag = VK_TRUE;
  const VkPhysicalDeviceVulkan13Features& asked = host().needs.vulkan13;
  constexpr size_t first = offsetof(VkPhysicalDeviceVulkan13Features, robustImageAccess);
  EXPECT_EQ(std::memcmp(reinterpret_cast<const char*>(&asked) + first, reinterpret_cast<const char*>(&all.vulkan13) + first,
                        offsetof(VkPhysicalDeviceVulkan13Features, maintenance4) + sizeof(VkBool32) - first),
            0);
  const VkPhysicalDeviceFeatures none{};
  EXPECT_EQ(std::memcmp(&host().needs.features.features, &none, sizeof none), 0);
}

TEST_F(Contract, AppendRequiredKeepsHostFeatures) {
  DeviceRequirements needs;
  needs.features.features.samplerAnisotropy = needs.vulkan13.inlineUniformBlock = VK_TRUE;
  ASSERT_TRUE(appendRequired(Interceptor::getInstanceProcAddr(), host().instance, host().physical, needs));
  EXPECT_TRUE(needs.features.features.samplerAnisotropy);
  EXPECT_TRUE(needs.vulkan13.inlineUniformBlock);
  VkPhysicalDeviceVulkan12Features own{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  const VkPhysicalDeviceFeatures2* chain = needs.chain(&own);
  EXPECT_EQ(chain, &needs.features);
  EXPECT_EQ(chain->pNext, &needs.vulkan13);
  EXPECT_EQ(needs.vulkan13.pNext, &own);
  HostDevice hostDevice = host().hostDevice();
  hostDevice.enabled = chain;
  EXPECT_TRUE(Device::borrow(hostDevice));
}

TEST(ContractFeatures, RejectsDeviceWithoutRequiredFeature) {
  for (const Feature& feature : kFeatures) {
    SCOPED_TRACE(feature.name);
    const auto host = Host::open(feature.flag);
    ASSERT_TRUE(host);
    expectRefused(host->hostDevice(), ErrorKind::NoDevice, std::string("feature ") + feature.name);
    EXPECT_TRUE(host->interceptor.liveObjects().empty());
    for (const std::string& message : host->takeMessages()) ADD_FAILURE() << message;
  }
}

// Proves that the absence of messages in the other tests is meaningful.
TEST_F(Contract, ValidationMessagesReachHost) {
  const VkFenceCreateInfo wrong{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0x80};
  VkFence fence = VK_NULL_HANDLE;
  ASSERT_EQ(host().vk.CreateFence(host().device, &wrong, nullptr, &fence), VK_SUCCESS);
  host().vk.DestroyFence(host().device, fence, nullptr);
  EXPECT_EQ(host().takeMessages().size(), 1u);
}

TEST_F(Contract, RejectsPhysicalDeviceWithoutRequiredFeature) {
  for (const Feature& feature : kFeatures) {
    SCOPED_TRACE(feature.name);
    interceptor().missingFeature = feature.flag;
    DeviceRequirements needs;
    const auto refused = appendRequired(Interceptor::getInstanceProcAddr(), host().instance, host().physical, needs);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::NoDevice);
    EXPECT_NE(refused.error().message.find(feature.name), std::string::npos) << refused.error().message;
  }
}

TEST_F(Contract, RejectsPhysicalDeviceWithoutSubgroupsOrTexelFormats) {
  const auto refusal = [&] {
    DeviceRequirements needs;
    const auto refused = appendRequired(Interceptor::getInstanceProcAddr(), host().instance, host().physical, needs);
    return refused ? std::string("accepted") : refused.error().message;
  };
  EXPECT_EQ(refusal(), "accepted");
  for (const VkSubgroupFeatureFlagBits operation :
       {VK_SUBGROUP_FEATURE_VOTE_BIT, VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, VK_SUBGROUP_FEATURE_SHUFFLE_BIT}) {
    interceptor().missingSubgroupOperations = operation;
    EXPECT_NE(refusal().find("subgroup operations in compute shaders: "), std::string::npos) << refusal();
  }
  interceptor().missingSubgroupOperations = VK_SUBGROUP_FEATURE_BALLOT_BIT;
  EXPECT_EQ(refusal(), "accepted") << "no shader uses it";
  interceptor().missingSubgroupOperations = 0;
  interceptor().subgroupSize = 2;
  EXPECT_NE(refusal().find("at least 4 invocations: this device has 2"), std::string::npos) << refusal();
  interceptor().subgroupSize = 0;
  interceptor().missingTexelFormat = VK_FORMAT_R32_UINT;
  EXPECT_NE(refusal().find("uniform texel buffers of R32_UINT"), std::string::npos) << refusal();
}

TEST_F(Contract, RejectsQueueWithoutComputeAndRendererWithoutGraphics) {
  interceptor().missingQueueFlags = VK_QUEUE_COMPUTE_BIT;
  expectRefused(host().hostDevice(), ErrorKind::BadInput, "expected a family with compute");
  interceptor().missingQueueFlags = VK_QUEUE_GRAPHICS_BIT;
  auto device = Device::borrow(host().hostDevice());
  ASSERT_TRUE(device) << device.error().message;
  const auto renderer = FluidRenderer::create(*device);
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().kind, ErrorKind::NoDevice);
}

TEST_F(Contract, AcceptsFeaturesInPromotedStructures) {
  VkPhysicalDeviceSynchronization2Features synchronization{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES, nullptr, VK_TRUE};
  VkPhysicalDeviceDynamicRenderingFeatures rendering{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES, &synchronization,
                                                     VK_TRUE};
  VkPhysicalDeviceMaintenance4Features maintenance{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES, &rendering, VK_TRUE};
  VkPhysicalDeviceSubgroupSizeControlFeatures sizes{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES, &maintenance, VK_TRUE,
                                                    VK_TRUE};
  const VkPhysicalDeviceFeatures2 enabled{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &sizes, {}};
  HostDevice hostDevice = host().hostDevice();
  hostDevice.enabled = &enabled;
  EXPECT_TRUE(Device::borrow(hostDevice));
}

TEST_F(Contract, NamesInvalidHostFields) {
  const auto without = [&](auto member, auto value) {
    HostDevice hostDevice = host().hostDevice();
    hostDevice.*member = value;
    return hostDevice;
  };
  const MemoryHooks hooks;
  expectRefused(without(&HostDevice::instance, VkInstance{}), ErrorKind::BadInput, "instance is null");
  expectRefused(without(&HostDevice::physicalDevice, VkPhysicalDevice{}), ErrorKind::BadInput, "physicalDevice is null");
  expectRefused(without(&HostDevice::device, VkDevice{}), ErrorKind::BadInput, "device is null");
  expectRefused(without(&HostDevice::getInstanceProcAddr, nullptr), ErrorKind::BadInput, "getInstanceProcAddr is null");
  expectRefused(without(&HostDevice::enabled, nullptr), ErrorKind::BadInput, "enabled is null");
  expectRefused(without(&HostDevice::apiVersion, VK_API_VERSION_1_2), ErrorKind::BadInput, "apiVersion is 1.2.0; expected 1.3 or newer");
  expectRefused(without(&HostDevice::queueFamily, 1000u), ErrorKind::BadInput, "no such family");
  expectRefused(without(&HostDevice::memory, &hooks), ErrorKind::BadInput, "memory: allocate or free is null");
}

}  // namespace
}  // namespace rill::test
