#include "support/null_vulkan.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string_view>

namespace rill::test {
namespace {

NullVulkan* current = nullptr;  // Vulkan functions carry no user pointer
std::vector<std::unique_ptr<std::byte[]>> mappings;

template <class Handle>
Handle newHandle() {
  static uint64_t next = 1000;
  ++current->liveObjects;
  return reinterpret_cast<Handle>(++next);
}
template <class Handle, class... Rest>
void destroy(VkDevice, Handle handle, Rest...) {
  if (handle) --current->liveObjects;
}
template <class Info, class Handle>
VkResult create(VkDevice, const Info*, const VkAllocationCallbacks*, Handle* out) {
  *out = newHandle<Handle>();
  return VK_SUCCESS;
}

void features(VkPhysicalDevice, VkPhysicalDeviceFeatures2* out) {
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES) {
      auto& f = *reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(next);
      f.synchronization2 = f.dynamicRendering = f.maintenance4 = f.subgroupSizeControl = f.computeFullSubgroups = VK_TRUE;
      for (const auto missing : current->properties.missingFeatures) f.*missing = VK_FALSE;
    }
}

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

// Relies on each buffer's memory being allocated and mapped before the next buffer is created.
uint64_t newestBuffer = 0, newestAllocation = 0;

VkResult createBuffer(VkDevice, const VkBufferCreateInfo* info, const VkAllocationCallbacks*, VkBuffer* out) {
  ++current->buffersCreated;
  current->bufferBytes += newestBuffer = info->size;
  *out = newHandle<VkBuffer>();
  return VK_SUCCESS;
}

VkResult createView(VkDevice, const VkBufferViewCreateInfo*, const VkAllocationCallbacks*, VkBufferView* out) {
  ++current->viewsCreated;
  *out = newHandle<VkBufferView>();
  return VK_SUCCESS;
}

void bufferRequirements(VkDevice, VkBuffer, VkMemoryRequirements* out) { *out = {std::max<uint64_t>(4096, newestBuffer), 64, 1}; }

VkResult allocateMemory(VkDevice, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks*, VkDeviceMemory* out) {
  if (current->allocationResult != VK_SUCCESS) return current->allocationResult;
  newestAllocation = info->allocationSize;
  *out = newHandle<VkDeviceMemory>();
  return VK_SUCCESS;
}

VkResult bindMemory(VkDevice, VkBuffer, VkDeviceMemory, VkDeviceSize) { return VK_SUCCESS; }
VkResult bindImage(VkDevice, VkImage, VkDeviceMemory, VkDeviceSize) { return VK_SUCCESS; }

VkResult createImage(VkDevice, const VkImageCreateInfo*, const VkAllocationCallbacks*, VkImage* out) {
  ++current->imagesCreated;
  *out = newHandle<VkImage>();
  return VK_SUCCESS;
}

void imageRequirements(VkDevice, const VkDeviceImageMemoryRequirements* info, VkMemoryRequirements2* out) {
  const VkExtent3D size = info->pCreateInfo->extent;
  out->memoryRequirements = {uint64_t{size.width} * size.height * 4, 1024, 1};
}

VkResult mapMemory(VkDevice, VkDeviceMemory, VkDeviceSize, VkDeviceSize, VkMemoryMapFlags, void** out) {
  mappings.push_back(std::make_unique<std::byte[]>(newestAllocation));
  *out = mappings.back().get();
  return VK_SUCCESS;
}

std::map<VkShaderModule, std::vector<uint32_t>> moduleWords;

VkResult createModule(VkDevice, const VkShaderModuleCreateInfo* info, const VkAllocationCallbacks*, VkShaderModule* out) {
  *out = newHandle<VkShaderModule>();
  moduleWords[*out].assign(info->pCode, info->pCode + info->codeSize / 4);
  return VK_SUCCESS;
}

/// A stage's part of the key of a pipeline.
std::string keyOf(const VkPipelineShaderStageCreateInfo& stage) {
  const std::vector<uint32_t>& words = moduleWords.at(stage.module);
  std::string key(reinterpret_cast<const char*>(words.data()), words.size() * 4);
  key += std::to_string(stage.flags);
  if (const VkSpecializationInfo* info = stage.pSpecializationInfo) key.append(static_cast<const char*>(info->pData), info->dataSize);
  for (auto* next = static_cast<const VkBaseInStructure*>(stage.pNext); next; next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO)
      key += std::to_string(reinterpret_cast<const VkPipelineShaderStageRequiredSubgroupSizeCreateInfo*>(next)->requiredSubgroupSize);
  return key;
}

void compile(VkPipelineCache given, const std::string& key) {
  auto* cache = reinterpret_cast<NullCache*>(given);
  if (!cache || cache->insert(key).second) ++current->pipelinesCompiled;
}

VkResult createPipelines(VkDevice, VkPipelineCache cache, uint32_t count, const VkComputePipelineCreateInfo* infos,
                         const VkAllocationCallbacks*, VkPipeline* out) {
  for (uint32_t i = 0; i < count; ++i) {
    out[i] = newHandle<VkPipeline>();
    compile(cache, keyOf(infos[i].stage));
    NullPipeline made{0,
                      (infos[i].stage.flags & VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT) != 0,
                      {},
                      moduleWords.at(infos[i].stage.module)};
    if (const VkSpecializationInfo* info = infos[i].stage.pSpecializationInfo) {
      made.constants.resize(info->dataSize / 4);
      std::memcpy(made.constants.data(), info->pData, made.constants.size() * 4);
    }
    for (auto* next = static_cast<const VkBaseInStructure*>(infos[i].stage.pNext); next; next = next->pNext)
      if (next->sType == VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO)
        made.requiredSubgroupSize =
            reinterpret_cast<const VkPipelineShaderStageRequiredSubgroupSizeCreateInfo*>(next)->requiredSubgroupSize;
    current->pipelines.push_back(made);
  }
  return VK_SUCCESS;
}

VkResult createGraphics(VkDevice, VkPipelineCache cache, uint32_t count, const VkGraphicsPipelineCreateInfo* infos,
                        const VkAllocationCallbacks*, VkPipeline* out) {
  for (uint32_t i = 0; i < count; ++i) {
    out[i] = newHandle<VkPipeline>();
    std::string key;  // of what the engine varies: formats are the same in one test
    for (uint32_t s = 0; s < infos[i].stageCount; ++s) key += keyOf(infos[i].pStages[s]);
    compile(cache, key);
  }
  return VK_SUCCESS;
}

VkResult allocateSets(VkDevice, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* out) {
  static uint64_t next = 1;
  current->setsAllocated += info->descriptorSetCount;
  for (uint32_t i = 0; i < info->descriptorSetCount; ++i) out[i] = reinterpret_cast<VkDescriptorSet>(++next);
  return VK_SUCCESS;
}

VkResult resetPool(VkDevice, VkDescriptorPool, VkDescriptorPoolResetFlags) { return VK_SUCCESS; }
void updateSets(VkDevice, uint32_t, const VkWriteDescriptorSet*, uint32_t, const VkCopyDescriptorSet*) {}

VkResult queryResults(VkDevice, VkQueryPool, uint32_t, uint32_t count, size_t, void* data, VkDeviceSize, VkQueryResultFlags) {
  auto* out = static_cast<uint64_t*>(data);
  for (uint32_t i = 0; i < count; ++i) out[i] = uint64_t(i) * 1000;
  return VK_SUCCESS;
}

template <class T>
uint64_t id(T handle) {
  return reinterpret_cast<uint64_t>(handle);
}
void add(NullCommand::Kind kind, uint64_t handle = 0, uint64_t a = 0, uint64_t b = 0, uint64_t c = 0) {
  current->commands.push_back({kind, {}, handle, a, b, c});
}
void cmdBarrier(VkCommandBuffer, const VkDependencyInfo* info) {
  current->imageBarriers.insert(current->imageBarriers.end(), info->pImageMemoryBarriers,
                                info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
  const VkMemoryBarrier2 memory = info->memoryBarrierCount ? info->pMemoryBarriers[0] : VkMemoryBarrier2{};
  current->commands.push_back({NullCommand::Barrier, memory, info->memoryBarrierCount, info->imageMemoryBarrierCount, 0, 0});
}
void cmdBindPipeline(VkCommandBuffer, VkPipelineBindPoint, VkPipeline pipeline) { add(NullCommand::BindPipeline, id(pipeline)); }
void cmdBindSets(VkCommandBuffer, VkPipelineBindPoint, VkPipelineLayout, uint32_t, uint32_t, const VkDescriptorSet* sets, uint32_t,
                 const uint32_t*) {
  add(NullCommand::BindSet, id(sets[0]));
}
void cmdPush(VkCommandBuffer, VkPipelineLayout, VkShaderStageFlags, uint32_t, uint32_t, const void*) {}
void cmdDispatch(VkCommandBuffer, uint32_t x, uint32_t y, uint32_t z) { add(NullCommand::Dispatch, 0, x, y, z); }
void cmdDispatchIndirect(VkCommandBuffer, VkBuffer buffer, VkDeviceSize offset) { add(NullCommand::DispatchIndirect, id(buffer), offset); }
void cmdBeginRendering(VkCommandBuffer, const VkRenderingInfo* info) {
  const VkRenderingAttachmentInfo* first = info->colorAttachmentCount ? info->pColorAttachments : info->pDepthAttachment;
  add(NullCommand::BeginRendering, info->colorAttachmentCount, first->loadOp, first->storeOp, info->pDepthAttachment != nullptr);
}
void cmdEndRendering(VkCommandBuffer) { add(NullCommand::EndRendering); }
void cmdDraw(VkCommandBuffer, uint32_t vertices, uint32_t instances, uint32_t, uint32_t) { add(NullCommand::Draw, 0, vertices, instances); }
void cmdDrawIndirect(VkCommandBuffer, VkBuffer buffer, VkDeviceSize offset, uint32_t, uint32_t) {
  add(NullCommand::DrawIndirect, id(buffer), offset);
}
void cmdScissor(VkCommandBuffer, uint32_t, uint32_t, const VkRect2D*) {}
void cmdViewport(VkCommandBuffer, uint32_t, uint32_t, const VkViewport*) {}
void cmdCopy(VkCommandBuffer, VkBuffer, VkBuffer target, uint32_t, const VkBufferCopy* region) {
  add(NullCommand::Copy, id(target), region->srcOffset, region->dstOffset, region->size);
}
void cmdUpdate(VkCommandBuffer, VkBuffer target, VkDeviceSize offset, VkDeviceSize bytes, const void*) {
  add(NullCommand::Update, id(target), offset, bytes);
}
void cmdCopyToImage(VkCommandBuffer, VkBuffer, VkImage target, VkImageLayout layout, uint32_t, const VkBufferImageCopy* region) {
  add(NullCommand::CopyToImage, id(target), layout, region->imageExtent.width, region->imageExtent.height);
}
void cmdCopyFromImage(VkCommandBuffer, VkImage source, VkImageLayout layout, VkBuffer, uint32_t, const VkBufferImageCopy* region) {
  add(NullCommand::CopyFromImage, id(source), layout, region->imageExtent.width, region->imageExtent.height);
}
void cmdCopyImage(VkCommandBuffer, VkImage, VkImageLayout, VkImage target, VkImageLayout layout, uint32_t, const VkImageCopy* region) {
  add(NullCommand::CopyImage, id(target), layout, region->extent.width, region->extent.height);
}
void cmdClearImage(VkCommandBuffer, VkImage target, VkImageLayout layout, const VkClearColorValue*, uint32_t,
                   const VkImageSubresourceRange*) {
  add(NullCommand::ClearImage, id(target), layout);
}
void cmdFill(VkCommandBuffer, VkBuffer target, VkDeviceSize offset, VkDeviceSize bytes, uint32_t value) {
  add(NullCommand::Fill, id(target), value, offset, bytes);
}
void cmdResetQueries(VkCommandBuffer, VkQueryPool, uint32_t, uint32_t count) { add(NullCommand::ResetQueries, 0, count); }
void cmdTimestamp(VkCommandBuffer, VkPipelineStageFlags2, VkQueryPool, uint32_t query) { add(NullCommand::Timestamp, 0, query); }

PFN_vkVoidFunction lookUp(std::string_view name) {
#define RILL_FUNCTION(vulkan, function) \
  if (name == #vulkan) return reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_##vulkan>(function));
  RILL_FUNCTION(vkEnumerateDeviceExtensionProperties, extensions)
  RILL_FUNCTION(vkGetPhysicalDeviceFeatures2, features)
  RILL_FUNCTION(vkGetPhysicalDeviceFormatProperties, formatProperties)
  RILL_FUNCTION(vkGetPhysicalDeviceMemoryProperties, memoryProperties)
  RILL_FUNCTION(vkGetPhysicalDeviceMemoryProperties2, memoryBudget)
  RILL_FUNCTION(vkGetPhysicalDeviceProperties2, properties)
  RILL_FUNCTION(vkGetPhysicalDeviceQueueFamilyProperties, queueFamilies)
  RILL_FUNCTION(vkAllocateDescriptorSets, allocateSets)
  RILL_FUNCTION(vkAllocateMemory, allocateMemory)
  RILL_FUNCTION(vkBindBufferMemory, bindMemory)
  RILL_FUNCTION(vkBindImageMemory, bindImage)
  RILL_FUNCTION(vkCmdBeginRendering, cmdBeginRendering)
  RILL_FUNCTION(vkCmdBindDescriptorSets, cmdBindSets)
  RILL_FUNCTION(vkCmdBindPipeline, cmdBindPipeline)
  RILL_FUNCTION(vkCmdClearColorImage, cmdClearImage)
  RILL_FUNCTION(vkCmdCopyBuffer, cmdCopy)
  RILL_FUNCTION(vkCmdCopyBufferToImage, cmdCopyToImage)
  RILL_FUNCTION(vkCmdCopyImage, cmdCopyImage)
  RILL_FUNCTION(vkCmdCopyImageToBuffer, cmdCopyFromImage)
  RILL_FUNCTION(vkCmdDispatch, cmdDispatch)
  RILL_FUNCTION(vkCmdDispatchIndirect, cmdDispatchIndirect)
  RILL_FUNCTION(vkCmdDraw, cmdDraw)
  RILL_FUNCTION(vkCmdDrawIndirect, cmdDrawIndirect)
  RILL_FUNCTION(vkCmdEndRendering, cmdEndRendering)
  RILL_FUNCTION(vkCmdFillBuffer, cmdFill)
  RILL_FUNCTION(vkCmdPipelineBarrier2, cmdBarrier)
  RILL_FUNCTION(vkCmdPushConstants, cmdPush)
  RILL_FUNCTION(vkCmdResetQueryPool, cmdResetQueries)
  RILL_FUNCTION(vkCmdSetScissor, cmdScissor)
  RILL_FUNCTION(vkCmdSetViewport, cmdViewport)
  RILL_FUNCTION(vkCmdUpdateBuffer, cmdUpdate)
  RILL_FUNCTION(vkCmdWriteTimestamp2, cmdTimestamp)
  RILL_FUNCTION(vkCreateBuffer, createBuffer)
  RILL_FUNCTION(vkCreateBufferView, createView)
  RILL_FUNCTION(vkCreateComputePipelines, createPipelines)
  RILL_FUNCTION(vkCreateDescriptorPool, create)
  RILL_FUNCTION(vkCreateDescriptorSetLayout, create)
  RILL_FUNCTION(vkCreateGraphicsPipelines, createGraphics)
  RILL_FUNCTION(vkCreateImage, createImage)
  RILL_FUNCTION(vkCreateImageView, create)
  RILL_FUNCTION(vkCreatePipelineLayout, create)
  RILL_FUNCTION(vkCreateQueryPool, create)
  RILL_FUNCTION(vkCreateShaderModule, createModule)
  RILL_FUNCTION(vkDestroyBuffer, destroy)
  RILL_FUNCTION(vkDestroyBufferView, destroy)
  RILL_FUNCTION(vkDestroyDescriptorPool, destroy)
  RILL_FUNCTION(vkDestroyDescriptorSetLayout, destroy)
  RILL_FUNCTION(vkDestroyImage, destroy)
  RILL_FUNCTION(vkDestroyImageView, destroy)
  RILL_FUNCTION(vkDestroyPipeline, destroy)
  RILL_FUNCTION(vkDestroyPipelineLayout, destroy)
  RILL_FUNCTION(vkDestroyQueryPool, destroy)
  RILL_FUNCTION(vkDestroyShaderModule, destroy)
  RILL_FUNCTION(vkFreeMemory, destroy)
  RILL_FUNCTION(vkGetBufferMemoryRequirements, bufferRequirements)
  RILL_FUNCTION(vkGetDeviceImageMemoryRequirements, imageRequirements)
  RILL_FUNCTION(vkGetQueryPoolResults, queryResults)
  RILL_FUNCTION(vkMapMemory, mapMemory)
  RILL_FUNCTION(vkResetDescriptorPool, resetPool)
  RILL_FUNCTION(vkUpdateDescriptorSets, updateSets)
#undef RILL_FUNCTION
  return nullptr;
}

PFN_vkVoidFunction getDeviceProc(VkDevice, const char* name) { return lookUp(name); }
PFN_vkVoidFunction getInstanceProc(VkInstance, const char* name) {
  if (std::string_view(name) == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProc);
  return lookUp(name);
}

}  // namespace

NullVulkan::NullVulkan() { current = this; }
NullVulkan::~NullVulkan() {
  current = nullptr;
  mappings.clear();
}

HostDevice NullVulkan::host(void* further) {
  vulkan13_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, further};
  features_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &vulkan13_};
  features(VK_NULL_HANDLE, &features_);
  HostDevice host;
  host.instance = reinterpret_cast<VkInstance>(uintptr_t(1));
  host.physicalDevice = reinterpret_cast<VkPhysicalDevice>(uintptr_t(1));
  host.device = reinterpret_cast<VkDevice>(uintptr_t(1));
  host.getInstanceProcAddr = &getInstanceProc;
  host.enabled = &features_;
  host.cache = reinterpret_cast<VkPipelineCache>(cache);
  return host;
}

size_t NullVulkan::count(NullCommand::Kind kind) const {
  return size_t(std::ranges::count_if(commands, [&](const NullCommand& c) { return c.kind == kind; }));
}

}  // namespace rill::test
