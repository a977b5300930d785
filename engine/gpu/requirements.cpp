// Device requirements, checked before vkCreateDevice (appendRequired) and in Device::borrow.
#include "gpu/requirements.hpp"

#include "gpu/function_table.hpp"

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

Error unsupported(const char* device, std::string what) {
  return {ErrorKind::NoDevice, std::string("device '") + device + "' cannot run Rill: " + std::move(what)};
}

}  // namespace

Expected<void> checkDevice(const InstanceTable& instance, VkPhysicalDevice device) {
  VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES, nullptr};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, nullptr};
  instance.GetPhysicalDeviceProperties2(device, &properties);
  const char* name = properties.properties.deviceName;
  if (properties.properties.apiVersion < VK_API_VERSION_1_3)
    return unsupported(name, "Vulkan version " + version(properties.properties.apiVersion) + "; expected 1.3 or newer");
  properties.pNext = &subgroup;
  instance.GetPhysicalDeviceProperties2(device, &properties);
  constexpr VkSubgroupFeatureFlags operations =
      VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT | VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
  if (!(subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) || (subgroup.supportedOperations & operations) != operations)
    return unsupported(name, "missing subgroup operations (basic, vote, arithmetic, shuffle) in compute shaders");
  if (subgroup.subgroupSize < 4)
    return unsupported(name, "subgroup size " + std::to_string(subgroup.subgroupSize) + "; expected at least 4");
  constexpr std::pair<VkFormat, const char*> formats[] = {{VK_FORMAT_R32G32B32A32_SFLOAT, "R32G32B32A32_SFLOAT"},
                                                          {VK_FORMAT_R32G32B32A32_UINT, "R32G32B32A32_UINT"},
                                                          {VK_FORMAT_R32G32_UINT, "R32G32_UINT"},
                                                          {VK_FORMAT_R32_UINT, "R32_UINT"}};
  for (const auto& [format, text] : formats) {
    VkFormatProperties support{};
    instance.GetPhysicalDeviceFormatProperties(device, format, &support);
    if (!(support.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT))
      return unsupported(name, std::string("missing uniform texel buffers of ") + text);
  }
  return {};
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
  VkPhysicalDeviceVulkan13Features vulkan13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, nullptr};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &vulkan13};
  table.GetPhysicalDeviceFeatures2(device, &features);
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, nullptr};
  table.GetPhysicalDeviceProperties2(device, &properties);
  for (const Feature& feature : kFeatures) {
    if (!(vulkan13.*feature.flag)) return unsupported(properties.properties.deviceName, std::string("missing feature ") + feature.name);
    requirements.vulkan13.*feature.flag = VK_TRUE;
  }
  return {};
}

Expected<void> checkEnabled(const VkPhysicalDeviceFeatures2& enabled) {
  const VkPhysicalDeviceVulkan13Features found = collectFeatures(enabled);
  for (const Feature& feature : kFeatures)
    if (!(found.*feature.flag))
      return Error{ErrorKind::NoDevice, std::string("the VkDevice was created without the required feature ") + feature.name +
                                            " (rill::appendRequired adds all required features)"};
  return {};
}

}  // namespace rill
