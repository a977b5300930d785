#include "support/null_vulkan.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>

#include "support/null_functions.hpp"

namespace rill::test {

NullVulkan* current = nullptr;

namespace {

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

PFN_vkVoidFunction lookUp(std::string_view name) {
  RILL_NULL_FUNCTION(vkAllocateDescriptorSets, allocateSets)
  RILL_NULL_FUNCTION(vkAllocateMemory, allocateMemory)
  RILL_NULL_FUNCTION(vkBindBufferMemory, bindMemory)
  RILL_NULL_FUNCTION(vkBindImageMemory, bindImage)
  RILL_NULL_FUNCTION(vkCreateBuffer, createBuffer)
  RILL_NULL_FUNCTION(vkCreateBufferView, createView)
  RILL_NULL_FUNCTION(vkCreateComputePipelines, createPipelines)
  RILL_NULL_FUNCTION(vkCreateDescriptorPool, create)
  RILL_NULL_FUNCTION(vkCreateDescriptorSetLayout, create)
  RILL_NULL_FUNCTION(vkCreateGraphicsPipelines, createGraphics)
  RILL_NULL_FUNCTION(vkCreateImage, createImage)
  RILL_NULL_FUNCTION(vkCreateImageView, create)
  RILL_NULL_FUNCTION(vkCreatePipelineLayout, create)
  RILL_NULL_FUNCTION(vkCreateQueryPool, create)
  RILL_NULL_FUNCTION(vkCreateShaderModule, createModule)
  RILL_NULL_FUNCTION(vkDestroyBuffer, destroy)
  RILL_NULL_FUNCTION(vkDestroyBufferView, destroy)
  RILL_NULL_FUNCTION(vkDestroyDescriptorPool, destroy)
  RILL_NULL_FUNCTION(vkDestroyDescriptorSetLayout, destroy)
  RILL_NULL_FUNCTION(vkDestroyImage, destroy)
  RILL_NULL_FUNCTION(vkDestroyImageView, destroy)
  RILL_NULL_FUNCTION(vkDestroyPipeline, destroy)
  RILL_NULL_FUNCTION(vkDestroyPipelineLayout, destroy)
  RILL_NULL_FUNCTION(vkDestroyQueryPool, destroy)
  RILL_NULL_FUNCTION(vkDestroyShaderModule, destroy)
  RILL_NULL_FUNCTION(vkFreeMemory, destroy)
  RILL_NULL_FUNCTION(vkGetBufferMemoryRequirements, bufferRequirements)
  RILL_NULL_FUNCTION(vkGetDeviceImageMemoryRequirements, imageRequirements)
  RILL_NULL_FUNCTION(vkGetQueryPoolResults, queryResults)
  RILL_NULL_FUNCTION(vkMapMemory, mapMemory)
  RILL_NULL_FUNCTION(vkResetDescriptorPool, resetPool)
  RILL_NULL_FUNCTION(vkUpdateDescriptorSets, updateSets)
  if (const auto found = nullProperty(name)) return found;
  return nullCommand(name);
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
  nullFeatures(VK_NULL_HANDLE, &features_);
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
