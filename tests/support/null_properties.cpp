// What the device says of itself.
#include <cstdio>

#include "support/null_functions.hpp"

namespace rill::test {

void nullFeatures(VkPhysicalDevice, VkPhysicalDeviceFeatures2* out) {
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES) {
      auto& f = *reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(next);
      f.synchronization2 = f.dynamicRendering = f.maintenance4 = f.subgroupSizeControl = f.computeFullSubgroups = VK_TRUE;
      for (const auto missing : current->properties.missingFeatures) f.*missing = VK_FALSE;
    }
}

namespace {

void properties(VkPhysicalDevice, VkPhysicalDeviceProperties2* out) {
  VkPhysicalDeviceProperties& p = out->properties;
  const NullProperties& given = current->properties;
  p.apiVersion = given.api;
  p.vendorID = given.vendor;
  std::snprintf(p.deviceName, sizeof p.deviceName, "%s", given.name);
  p.limits.maxStorageBufferRange = given.storageBufferRange;
  p.limits.maxUniformBufferRange = 65536;
  p.limits.maxImageDimension2D = 4096;
  p.limits.maxPerStageDescriptorStorageImages = p.limits.maxPerStageDescriptorSampledImages = 16;
  p.limits.maxTexelBufferElements = given.maxTexelBufferElements;
  p.limits.maxPerStageDescriptorStorageBuffers = given.storageBuffers;
  p.limits.maxComputeWorkGroupInvocations = given.workgroupInvocations;
  for (uint32_t& size : p.limits.maxComputeWorkGroupSize) size = given.workgroupInvocations;
  p.limits.minStorageBufferOffsetAlignment = p.limits.minUniformBufferOffsetAlignment = p.limits.minTexelBufferOffsetAlignment = 64;
  p.limits.timestampPeriod = 1;
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext) {
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES) {
      auto& s = *reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next);
      s.subgroupSize = given.subgroupSize;
      s.supportedStages = VK_SHADER_STAGE_COMPUTE_BIT;
      s.supportedOperations = given.subgroupOperations;
    } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES) {
      reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(next)->maxMemoryAllocationSize = given.maxAllocation;
    } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES) {
      reinterpret_cast<VkPhysicalDeviceMaintenance4Properties*>(next)->maxBufferSize = given.maxBufferSize;
    } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES) {
      auto& s = *reinterpret_cast<VkPhysicalDeviceSubgroupSizeControlProperties*>(next);
      s.minSubgroupSize = given.minSubgroupSize;
      s.maxSubgroupSize = given.maxSubgroupSize;
      s.maxComputeWorkgroupSubgroups = given.workgroupInvocations / given.minSubgroupSize;
      s.requiredSubgroupSizeStages = given.requiresSubgroupSize ? VK_SHADER_STAGE_COMPUTE_BIT : 0;
    }
  }
}

void formatProperties(VkPhysicalDevice, VkFormat, VkFormatProperties* out) {
  out->bufferFeatures = current->properties.texelBuffers ? VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT : 0;
  out->optimalTilingFeatures = VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
                               VK_FORMAT_FEATURE_TRANSFER_SRC_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT |
                               VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
}

void memoryProperties(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* out) {
  *out = {};
  out->memoryTypeCount = out->memoryHeapCount = 1;
  out->memoryTypes[0].propertyFlags =
      VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  out->memoryHeaps[0] = {current->properties.heapBytes, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

VkResult extensions(VkPhysicalDevice, const char*, uint32_t* count, VkExtensionProperties* out) {
  *count = current->properties.availableBytes ? 1 : 0;
  if (out && *count == 1) *out = {VK_EXT_MEMORY_BUDGET_EXTENSION_NAME, 1};
  return VK_SUCCESS;
}

void memoryBudget(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2* out) {
  memoryProperties(device, &out->memoryProperties);
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT) {
      auto& budget = *reinterpret_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(next);
      constexpr uint64_t used = 1000;
      budget.heapBudget[0] = current->properties.availableBytes.value() + used;
      budget.heapUsage[0] = used;
    }
}

void queueFamilies(VkPhysicalDevice, uint32_t* count, VkQueueFamilyProperties* out) {
  *count = 1;
  if (out) *out = {VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_TRANSFER_BIT, 1, 64, {1, 1, 1}};
}

}  // namespace

PFN_vkVoidFunction nullProperty(std::string_view name) {
  RILL_NULL_FUNCTION(vkEnumerateDeviceExtensionProperties, extensions)
  RILL_NULL_FUNCTION(vkGetPhysicalDeviceFeatures2, nullFeatures)
  RILL_NULL_FUNCTION(vkGetPhysicalDeviceFormatProperties, formatProperties)
  RILL_NULL_FUNCTION(vkGetPhysicalDeviceMemoryProperties, memoryProperties)
  RILL_NULL_FUNCTION(vkGetPhysicalDeviceMemoryProperties2, memoryBudget)
  RILL_NULL_FUNCTION(vkGetPhysicalDeviceProperties2, properties)
  RILL_NULL_FUNCTION(vkGetPhysicalDeviceQueueFamilyProperties, queueFamilies)
  return nullptr;
}

}  // namespace rill::test
