// What a fluid takes of devices, by the subgroups that their drivers describe. All other limits are the null device's: a driver may still
// lack Vulkan 1.3, as MoltenVK before 1.3 does. Sources: Mesa 24 (src/amd/vulkan/radv_physical_device.c,
// src/nouveau/vulkan/nvk_physical_device.c, src/intel/vulkan/anv_physical_device.c, src/freedreno/vulkan/tu_device.cc,
// src/panfrost/vulkan/panvk_vX_physical_device.c, src/broadcom/vulkan/v3dv_device.c), MoltenVK (MVKDevice.mm), the drivers themselves.
#include <gtest/gtest.h>

#include <spirv/unified1/spirv.hpp11>

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

class DevicesTest : public ::testing::TestWithParam<Row> {
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
                                         Row{device("GeForce RTX 2070 (Turing)", kNvidia, 32, 32, 32), 32, 32},
                                         Row{device("GeForce RTX 3070 (Ampere)", kNvidia, 32, 32, 32), 32, 32},
                                         Row{device("GeForce RTX 4070 (Ada)", kNvidia, 32, 32, 32), 32, 32},
                                         Row{device("GeForce RTX 4070 (NVK, Mesa 23)", kNvidia, 32, 32, 32, false), 0, 32},
                                         Row{device("Radeon RX 6800 (RDNA 2)", kAmd, 64, 32, 64), 32, 32},
                                         Row{device("Radeon RX 7800 (RDNA 3)", kAmd, 64, 32, 64), 32, 32},
                                         Row{device("Radeon RX 580 (GCN)", kAmd, 64, 64, 64, false), 0, 32},
                                         Row{device("Arc A770", kIntel, 32, 8, 32), 16, 16},
                                         Row{device("Iris Xe", kIntel, 32, 8, 32), 16, 16},
                                         Row{device("Adreno 740", kQualcomm, 128, 64, 128), 64, 32},
                                         Row{device("Mali-G710", kArm, 16, 16, 16, false, 1u << 28), 0, 16},
                                         Row{device("Mali-G52 (Bifrost)", kArm, 8, 8, 8, false, 1u << 28), 0, 8},
                                         Row{device("V3D 7.1 (Raspberry Pi 5)", kBroadcom, 16, 16, 16), 16, 16}));

TEST_F(DevicesTest, RejectsSubgroupsAboveTheWorkgroupWithoutControl) {
  vulkan.properties = device("wide", kQualcomm, 128, 64, 128, false);
  EXPECT_EQ(
      create(),
      "device 'wide' cannot run a fluid: its subgroups are of up to 128 invocations, which do not divide workgroups of 64, and no size "
      "can be required in compute shaders");
  EXPECT_EQ(vulkan.bufferBytes, 0u) << "before anything is allocated";
}

TEST_F(DevicesTest, RejectsDeviceWithoutShuffles) {
  vulkan.properties = device("plain", kBroadcom, 16, 16, 16);
  vulkan.properties.subgroupOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
  EXPECT_EQ(create(), "device 'plain' cannot run Rill: missing subgroup operations (basic, vote, arithmetic, shuffle) in compute shaders");
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

TEST_F(DevicesTest, ShadersAskForTheReconvergenceThatTheHostEnabled) {
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
