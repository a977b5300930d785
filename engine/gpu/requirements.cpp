// Device requirements, checked before vkCreateDevice (appendRequired) and in Device::borrow.
#include "gpu/requirements.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "gpu/function_table.hpp"
#include "gpu/shader_library.hpp"
#include "gpu/workgroup_size.hpp"

namespace rill {
namespace {

struct Feature {
  const char* name;
  VkBool32 VkPhysicalDeviceVulkan13Features::*flag;
};

// Mandatory in Vulkan 1.3, but hosts must enable them. maintenance4: workgroup sizes from specialization constants.
constexpr Feature kFeatures[] = {
    {"synchronization2", &VkPhysicalDeviceVulkan13Features::synchronization2},
    {"dynamicRendering", &VkPhysicalDeviceVulkan13Features::dynamicRendering},
    {"maintenance4", &VkPhysicalDeviceVulkan13Features::maintenance4},
    {"subgroupSizeControl", &VkPhysicalDeviceVulkan13Features::subgroupSizeControl},
    {"computeFullSubgroups", &VkPhysicalDeviceVulkan13Features::computeFullSubgroups},
};

std::string version(uint32_t v) { return std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)); }

/// The 1.3 features enabled in a chain, in the 1.3 structure or in the structures promoted into it.
VkPhysicalDeviceVulkan13Features collectFeatures(const VkPhysicalDeviceFeatures2& enabled) {
  VkPhysicalDeviceVulkan13Features found{};
  for (auto* next = static_cast<const VkBaseInStructure*>(enabled.pNext); next; next = next->pNext) {
    switch (next->sType) {
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES: {
        const auto& f = *reinterpret_cast<const VkPhysicalDeviceVulkan13Features*>(next);
        for (const Feature& feature : kFeatures) found.*feature.flag |= f.*feature.flag;
        break;
      }
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
        found.synchronization2 |= reinterpret_cast<const VkPhysicalDeviceSynchronization2Features*>(next)->synchronization2;
        break;
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES:
        found.dynamicRendering |= reinterpret_cast<const VkPhysicalDeviceDynamicRenderingFeatures*>(next)->dynamicRendering;
        break;
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES:
        found.maintenance4 |= reinterpret_cast<const VkPhysicalDeviceMaintenance4Features*>(next)->maintenance4;
        break;
      case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES: {
        const auto& f = *reinterpret_cast<const VkPhysicalDeviceSubgroupSizeControlFeatures*>(next);
        found.subgroupSizeControl |= f.subgroupSizeControl;
        found.computeFullSubgroups |= f.computeFullSubgroups;
        break;
      }
      default:
        break;
    }
  }
  return found;
}

constexpr const char* kNewerDriver = "part of Vulkan 1.3: a newer driver may have it";

/// What a device lacks, each with what would help.
using Missing = std::vector<std::string>;

void addSubgroups(const VkPhysicalDeviceSubgroupProperties& subgroup, Missing& missing) {
  constexpr std::pair<VkSubgroupFeatureFlagBits, const char*> operations[] = {{VK_SUBGROUP_FEATURE_BASIC_BIT, "basic"},
                                                                              {VK_SUBGROUP_FEATURE_VOTE_BIT, "vote"},
                                                                              {VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, "arithmetic"},
                                                                              {VK_SUBGROUP_FEATURE_SHUFFLE_BIT, "shuffle"}};
  const bool compute = (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  for (const auto& [operation, name] : operations)
    if (!compute || !(subgroup.supportedOperations & operation))
      missing.push_back(std::string("subgroup operations in compute shaders: ") + name + " (a newer driver may have them)");
  if (subgroup.subgroupSize < 4)
    missing.push_back("subgroups of at least 4 invocations: this device has " + std::to_string(subgroup.subgroupSize));
}

/// Of all shaders, so that no kernel is refused after memory has been allocated.
void addLimits(const VkPhysicalDeviceLimits& limits, Missing& missing) {
  uint64_t buffers = 0, invocations = 0, width = 0;
  for (const EmbeddedShader& shader : embeddedShaders()) {
    if (!isCompute(shader.words)) continue;
    const WorkgroupSize size = workgroupSize(shader.words);
    invocations = std::max(invocations, size.invocations());
    width = std::max<uint64_t>(width, size.x);
    buffers = std::max<uint64_t>(buffers, std::ranges::count(shader.bindings, BindingKind::Storage, &ShaderBinding::kind));
  }
  const auto atLeast = [&](uint64_t found, uint64_t expected, const char* limit, const char* what) {
    if (found < expected)
      missing.push_back(std::string(what) + ": expected " + limit + " of at least " + std::to_string(expected) + ", found " +
                        std::to_string(found) + " (a limit of the driver: a newer one may raise it)");
  };
  atLeast(limits.maxComputeWorkGroupInvocations, invocations, "maxComputeWorkGroupInvocations", "workgroups that are large enough");
  atLeast(limits.maxComputeWorkGroupSize[0], width, "maxComputeWorkGroupSize[0]", "workgroups that are wide enough");
  atLeast(limits.maxPerStageDescriptorStorageBuffers, buffers, "maxPerStageDescriptorStorageBuffers", "storage buffers in a shader");
}

void addFormats(const InstanceTable& instance, VkPhysicalDevice device, Missing& missing) {
  constexpr std::pair<VkFormat, const char*> formats[] = {{VK_FORMAT_R32G32B32A32_SFLOAT, "R32G32B32A32_SFLOAT"},
                                                          {VK_FORMAT_R32G32B32A32_UINT, "R32G32B32A32_UINT"},
                                                          {VK_FORMAT_R32G32_UINT, "R32G32_UINT"},
                                                          {VK_FORMAT_R32_UINT, "R32_UINT"}};
  for (const auto& [format, text] : formats) {
    VkFormatProperties support{};
    instance.GetPhysicalDeviceFormatProperties(device, format, &support);
    if (!(support.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT))
      missing.push_back(std::string("uniform texel buffers of ") + text + " (a newer driver may have them)");
  }
}

void addFeatures(const InstanceTable& instance, VkPhysicalDevice device, Missing& missing) {
  VkPhysicalDeviceVulkan13Features vulkan13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, nullptr};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &vulkan13};
  instance.GetPhysicalDeviceFeatures2(device, &features);
  for (const Feature& feature : kFeatures)
    if (!(vulkan13.*feature.flag)) missing.push_back(std::string("feature ") + feature.name + " (" + kNewerDriver + ")");
}

Expected<void> refuse(const char* device, const Missing& missing) {
  if (missing.empty()) return {};
  std::string message = std::string("device '") + device + "' cannot run Rill. It lacks:";
  for (const std::string& line : missing) message += "\n  " + line;
  return Error{ErrorKind::NoDevice, std::move(message)};
}

}  // namespace

Expected<void> checkDevice(const InstanceTable& instance, VkPhysicalDevice device) {
  VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES, nullptr};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, nullptr};
  instance.GetPhysicalDeviceProperties2(device, &properties);
  const VkPhysicalDeviceProperties& found = properties.properties;
  Missing missing;
  if (found.apiVersion < VK_API_VERSION_1_3)
    missing.push_back("Vulkan 1.3 with its features: its driver has " + version(found.apiVersion) + " (a newer driver may have it)");
  if (found.apiVersion >= VK_API_VERSION_1_1) {  // Vulkan 1.0 has no query for subgroups
    properties.pNext = &subgroup;
    instance.GetPhysicalDeviceProperties2(device, &properties);
    addSubgroups(subgroup, missing);
  }
  if (found.apiVersion >= VK_API_VERSION_1_3) addFeatures(instance, device, missing);
  addLimits(found.limits, missing);
  addFormats(instance, device, missing);
  return refuse(found.deviceName, missing);
}

VkPhysicalDeviceFeatures2* DeviceRequirements::chain(void* next) {
  vulkan13.pNext = next;
  features.pNext = &vulkan13;
  return &features;
}

Expected<void> appendRequired(PFN_vkGetInstanceProcAddr get, VkInstance instance, VkPhysicalDevice device,
                              DeviceRequirements& requirements) {
  InstanceTable table;
  if (!get || !instance || !device)
    return Error{ErrorKind::BadInput, "appendRequired: getInstanceProcAddr, instance or physicalDevice is null"};
  if (const char* missing = table.load(get, instance))
    return Error{ErrorKind::NoDevice,
                 std::string("Vulkan instance function not found: ") + missing + "; expected an instance of Vulkan 1.1 or newer"};
  if (auto ok = checkDevice(table, device); !ok) return ok;
  for (const Feature& feature : kFeatures) requirements.vulkan13.*feature.flag = VK_TRUE;
  return {};
}

Expected<void> checkEnabled(const VkPhysicalDeviceFeatures2& enabled) {
  const VkPhysicalDeviceVulkan13Features found = collectFeatures(enabled);
  std::string missing;
  for (const Feature& feature : kFeatures)
    if (!(found.*feature.flag)) missing += std::string("\n  feature ") + feature.name;
  if (missing.empty()) return {};
  return Error{ErrorKind::NoDevice,
               "the VkDevice was created without what Rill requires (rill::appendRequired adds all of it). It lacks:" + missing};
}

}  // namespace rill
