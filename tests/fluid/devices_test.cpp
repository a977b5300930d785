// What a fluid takes of devices, by what their drivers describe, and what it refuses them for. What a row does not say is the null
// device's. Sources: Mesa 24 (src/amd/vulkan/radv_physical_device.c, src/nouveau/vulkan/nvk_physical_device.c,
// src/intel/vulkan/anv_physical_device.c, src/freedreno/vulkan/tu_device.cc), the drivers themselves, and those named beside the rows.
#include <gtest/gtest.h>

#include <spirv/unified1/spirv.hpp11>
#include <sstream>

#include "gpu/reconvergence.hpp"
#include "rill/fluid.hpp"
#include "rill/particles.hpp"
#include "shared/fluid_records.h"
#include "support/null_vulkan.hpp"

namespace rill::test {
namespace devices_test {

constexpr uint32_t kAmd = 0x1002, kApple = 0x106b, kArm = 0x13b5, kBroadcom = 0x14e4, kIntel = 0x8086, kNvidia = 0x10de, kQualcomm = 0x5143;

struct Row {
  NullProperties device;
  uint32_t requiredSize, cluster;  ///< of passes with clusters; 0: no size is required
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.device.name; }

NullProperties device(const char* name, uint32_t vendor, uint32_t size, uint32_t smallest, uint32_t largest, bool canRequireSize = true,
                      uint32_t texels = 1u << 27) {
  return {.name = name,
          .vendor = vendor,
          .subgroupSize = size,
          .minSubgroupSize = smallest,
          .maxSubgroupSize = largest,
          .requiresSubgroupSize = canRequireSize,
          .maxTexelBufferElements = texels};
}

class DeviceTest : public ::testing::Test {
 protected:
  /// The message of a fluid that is not made, else nothing.
  std::string create(void* features = nullptr) {
    auto borrowed = Device::borrow(vulkan.host(features));
    if (!borrowed) return borrowed.error().message;
    device_ = std::move(*borrowed);
    device_->beginFrame({1, 0});
    Scene scene;
    scene.fluid.spacing = 0.1;
    scene.domain = Domain{};
    Fill fill;
    fill.shape = BoxShape{{0, 0, 0}, {0.5, 0.5, 0.5}};
    scene.fill.push_back(fill);
    const auto particles = makeParticles(scene);
    if (!particles) return particles.error().message;
    const auto fluid = Fluid::create(*device_, {.scene = &scene, .particles = &*particles});
    return fluid ? "" : fluid.error().message;
  }
  NullVulkan vulkan;
  std::optional<Device> device_;
};

class DevicesTest : public DeviceTest, public ::testing::WithParamInterface<Row> {};

TEST_P(DevicesTest, RunsAFluid) {
  const auto& [given, requiredSize, cluster] = GetParam();
  vulkan.properties = given;
  ASSERT_EQ(create(), "");
  size_t clustered = 0;
  for (const NullPipeline& pipeline : vulkan.pipelines) {
    if (pipeline.requiredSubgroupSize != 0) {
      EXPECT_TRUE(given.requiresSubgroupSize);
      EXPECT_EQ(pipeline.requiredSubgroupSize, requiredSize);
    }
    if (pipeline.constants.size() <= 3 || !pipeline.fullSubgroups) continue;
    if (pipeline.requiredSubgroupSize == 0) {
      EXPECT_EQ(kFluidGroup % given.maxSubgroupSize, 0u) << "full subgroups of any size need a multiple of the largest";
    }
    // Of constants.glsl: 1 is CLUSTER, 3 is WALKS.
    EXPECT_EQ(pipeline.constants[1], cluster);
    if (pipeline.constants[3] != 1) continue;
    ++clustered;
    EXPECT_EQ(pipeline.requiredSubgroupSize, requiredSize);
  }
  EXPECT_GT(clustered, 0u);
}

INSTANTIATE_TEST_SUITE_P(Known, DevicesTest,
                         testing::Values(Row{device("Apple M1 (MoltenVK)", kApple, 32, 4, 32, false), 0, 4},
                                         Row{device("GeForce RTX 2070 (Turing)", kNvidia, 32, 32, 32), 32, 8},
                                         Row{device("GeForce RTX 3070 (Ampere)", kNvidia, 32, 32, 32), 32, 8},
                                         Row{device("GeForce RTX 4070 (Ada)", kNvidia, 32, 32, 32), 32, 8},
                                         Row{device("GeForce RTX 4070 (NVK, Mesa 23)", kNvidia, 32, 32, 32, false), 0, 8},
                                         Row{device("Radeon RX 6800 (RDNA 2)", kAmd, 64, 32, 64), 32, 8},
                                         Row{device("Radeon RX 7800 (RDNA 3)", kAmd, 64, 32, 64), 32, 8},
                                         Row{device("Radeon RX 580 (GCN)", kAmd, 64, 64, 64, false), 0, 8},
                                         Row{device("Arc A770", kIntel, 32, 8, 32), 16, 16},
                                         Row{device("Iris Xe", kIntel, 32, 8, 32), 16, 16},
                                         Row{device("Adreno 740", kQualcomm, 128, 64, 128), 64, 8},
                                         // Mesa: panvk_vX_physical_device.c, architecture 10, Vulkan 1.4.
                                         Row{device("Mali-G710", kArm, 16, 16, 16, false, 1u << 28), 0, 16},
                                         // Modelled: Arm's own driver, of which only the subgroups are known here.
                                         Row{device("Mali-G52 (Arm's driver)", kArm, 8, 8, 8, false, 1u << 28), 0, 8}));

struct Refused {
  NullProperties device;
  std::vector<std::string> missing;  ///< lines of the message, without what would help
};

void PrintTo(const Refused& row, std::ostream* out) { *out << row.device.name; }

// Drivers that were read, and devices made up to lack one thing each.
std::vector<Refused> refusedDevices() {
  const std::string version = "Vulkan 1.3 with its features: its driver has ";
  const std::string subgroups = "subgroup operations in compute shaders: ";
  std::vector<Refused> rows;
  const auto add = [&](NullProperties device, std::vector<std::string> missing) -> NullProperties& {
    rows.push_back({std::move(device), std::move(missing)});
    return rows.back().device;
  };
  const std::string buffers = "storage buffers in a shader: expected maxPerStageDescriptorStorageBuffers of at least 16, found 8";
  // Mesa: v3dv_limits.h (MAX_STORAGE_BUFFERS), v3dv_device.c: the operations from V3D 7.1 on.
  add(device("V3D 7.1 (Raspberry Pi 5)", kBroadcom, 16, 16, 16), {buffers}).storageBuffers = 8;
  NullProperties& pi4 = add(device("V3D 4.2 (Raspberry Pi 4)", kBroadcom, 16, 16, 16),
                            {subgroups + "vote", subgroups + "arithmetic", subgroups + "shuffle", buffers});
  pi4.storageBuffers = 8;
  pi4.subgroupOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
  // Mesa: panvk_vX_physical_device.c, get_api_version(): Vulkan 1.0 before architecture 10, and so no query for subgroups.
  add(device("Mali-G52 (panvk)", kArm, 8, 8, 8, false), {version + "1.0"}).api = VK_API_VERSION_1_0;
  // github.com/KhronosGroup/MoltenVK/issues/1930: Vulkan 1.2 until 1.3.0.
  add(device("Apple M1 (MoltenVK 1.2)", kApple, 32, 4, 32, false), {version + "1.2"}).api = VK_API_VERSION_1_2;
  // Modelled, all below: drivers of Vulkan 1.1 with the smallest limits that the specification allows.
  NullProperties& old = add(device("old", kQualcomm, 64, 64, 64, false),
                            {version + "1.1", subgroups + "vote", subgroups + "arithmetic", subgroups + "shuffle",
                             "workgroups that are large enough: expected maxComputeWorkGroupInvocations of at least 256, found 128",
                             "workgroups that are wide enough: expected maxComputeWorkGroupSize[0] of at least 256, found 128",
                             "storage buffers in a shader: expected maxPerStageDescriptorStorageBuffers of at least 16, found 4",
                             "uniform texel buffers of R32G32B32A32_SFLOAT", "uniform texel buffers of R32G32B32A32_UINT",
                             "uniform texel buffers of R32G32_UINT", "uniform texel buffers of R32_UINT"});
  old.api = VK_API_VERSION_1_1;
  old.subgroupOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
  old.workgroupInvocations = 128;
  old.storageBuffers = 4;
  old.texelBuffers = false;
  add(device("no features", kIntel, 32, 8, 32), {"feature synchronization2", "feature maintenance4", "feature computeFullSubgroups"})
      .missingFeatures = {&VkPhysicalDeviceVulkan13Features::synchronization2, &VkPhysicalDeviceVulkan13Features::maintenance4,
                          &VkPhysicalDeviceVulkan13Features::computeFullSubgroups};
  add(device("scalar", kBroadcom, 1, 1, 1), {"subgroups of at least 4 invocations: this device has 1"});
  return rows;
}

class RefusedDevicesTest : public DeviceTest, public ::testing::WithParamInterface<Refused> {};

TEST_P(RefusedDevicesTest, NamesAllThatIsMissing) {
  const auto& [given, missing] = GetParam();
  vulkan.properties = given;
  std::istringstream message(create());
  std::string line;
  std::getline(message, line);
  EXPECT_EQ(line, "device '" + std::string(given.name) + "' cannot run Rill. It lacks:");
  for (const std::string& item : missing) {
    std::getline(message, line);
    EXPECT_TRUE(line.starts_with("  " + item)) << line << "\nexpected " << item;
  }
  EXPECT_FALSE(std::getline(message, line)) << line;
  EXPECT_EQ(vulkan.liveObjects, 0) << "before anything is made";
}

INSTANTIATE_TEST_SUITE_P(Known, RefusedDevicesTest, testing::ValuesIn(refusedDevices()));

TEST_F(DeviceTest, RejectsSubgroupsAboveTheWorkgroupWithoutControl) {
  vulkan.properties = device("wide", kQualcomm, 128, 64, 128, false);
  EXPECT_EQ(
      create(),
      "device 'wide' cannot run a fluid: its subgroups are of up to 128 invocations, which do not divide workgroups of 64, and no size "
      "can be required in compute shaders");
  EXPECT_EQ(vulkan.bufferBytes, 0u) << "before anything is allocated";
}

TEST_F(DeviceTest, SaysWhatWouldHelp) {
  vulkan.properties = device("plain", kBroadcom, 16, 16, 16);
  vulkan.properties.missingFeatures = {&VkPhysicalDeviceVulkan13Features::maintenance4};
  EXPECT_EQ(create(), "device 'plain' cannot run Rill. It lacks:\n  feature maintenance4 (part of Vulkan 1.3: a newer driver may have it)");
}

/// Whether the shader has the execution mode, in its place: after the entry points, with its extension before the memory model.
bool asksFor(const NullPipeline& pipeline, spv::ExecutionMode mode, std::string_view extension) {
  bool isExtended = false, asks = false, hasModel = false, hasEntry = false;
  const auto& words = pipeline.words;
  for (size_t at = 5; at < words.size(); at += words[at] >> 16) {
    const auto op = static_cast<spv::Op>(words[at] & 0xffffu);
    hasModel |= op == spv::Op::OpMemoryModel;
    hasEntry |= op == spv::Op::OpEntryPoint;
    if (op == spv::Op::OpExtension && !hasModel) isExtended |= extension == reinterpret_cast<const char*>(&words[at + 1]);
    if (op == spv::Op::OpExecutionMode && hasEntry) asks |= words[at + 2] == static_cast<uint32_t>(mode);
    if (op == spv::Op::OpFunction) break;
  }
  EXPECT_EQ(isExtended, asks);
  return asks;
}

TEST_F(DeviceTest, ShadersAskForTheReconvergenceThatTheHostEnabled) {
  constexpr auto kMaximal = spv::ExecutionMode(6023);  // newer than the oldest headers
  VkPhysicalDeviceShaderSubgroupUniformControlFlowFeaturesKHR uniform{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_FEATURES_KHR, nullptr, VK_TRUE};
  VkPhysicalDeviceShaderMaximalReconvergenceFeaturesKHR maximal{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_MAXIMAL_RECONVERGENCE_FEATURES_KHR,
                                                                &uniform, VK_TRUE};
  vulkan.properties = device("Radeon RX 580 (GCN)", kAmd, 64, 64, 64, false);
  for (void* features : {static_cast<void*>(nullptr), static_cast<void*>(&uniform), static_cast<void*>(&maximal)}) {
    vulkan.pipelines.clear();
    ASSERT_EQ(create(features), "");
    ASSERT_GT(vulkan.pipelines.size(), 0u);
    for (const NullPipeline& pipeline : vulkan.pipelines) {
      EXPECT_EQ(asksFor(pipeline, kMaximal, "SPV_KHR_maximal_reconvergence"), pipeline.fullSubgroups && features == &maximal);
      EXPECT_EQ(asksFor(pipeline, spv::ExecutionMode::SubgroupUniformControlFlowKHR, "SPV_KHR_subgroup_uniform_control_flow"),
                pipeline.fullSubgroups && features == &uniform);
    }
  }
}

}  // namespace devices_test
}  // namespace rill::test
