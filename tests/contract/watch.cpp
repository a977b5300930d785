#include "contract/watch.hpp"

#include <cstring>

#include "contract/loader.hpp"

namespace rill::test {
namespace {

std::atomic<Watch*> current = nullptr;

// Name, what it makes, structure that describes it.
#define RILL_MAKERS(X)                                                               \
  X(AllocateMemory, DeviceMemory, VkMemoryAllocateInfo)                              \
  X(CreateBuffer, Buffer, VkBufferCreateInfo)                                        \
  X(CreateBufferView, BufferView, VkBufferViewCreateInfo)                            \
  X(CreateDescriptorPool, DescriptorPool, VkDescriptorPoolCreateInfo)                \
  X(CreateDescriptorSetLayout, DescriptorSetLayout, VkDescriptorSetLayoutCreateInfo) \
  X(CreateImage, Image, VkImageCreateInfo)                                           \
  X(CreateImageView, ImageView, VkImageViewCreateInfo)                               \
  X(CreatePipelineLayout, PipelineLayout, VkPipelineLayoutCreateInfo)                \
  X(CreateQueryPool, QueryPool, VkQueryPoolCreateInfo)                               \
  X(CreateShaderModule, ShaderModule, VkShaderModuleCreateInfo)
#define RILL_PIPELINE_MAKERS(X)                          \
  X(CreateComputePipelines, VkComputePipelineCreateInfo) \
  X(CreateGraphicsPipelines, VkGraphicsPipelineCreateInfo)
#define RILL_DESTROYERS(X)                           \
  X(FreeMemory, DeviceMemory)                        \
  X(DestroyBuffer, Buffer)                           \
  X(DestroyBufferView, BufferView)                   \
  X(DestroyDescriptorPool, DescriptorPool)           \
  X(DestroyDescriptorSetLayout, DescriptorSetLayout) \
  X(DestroyImage, Image)                             \
  X(DestroyImageView, ImageView)                     \
  X(DestroyPipeline, Pipeline)                       \
  X(DestroyPipelineLayout, PipelineLayout)           \
  X(DestroyQueryPool, QueryPool)                     \
  X(DestroyShaderModule, ShaderModule)

#define RILL_BETWEEN(name, kind, Info)                                                                                                     \
  std::atomic<PFN_vk##name> real##name;                                                                                                    \
  VKAPI_ATTR VkResult VKAPI_CALL between##name(VkDevice device, const Info* info, const VkAllocationCallbacks* callbacks, Vk##kind* out) { \
    const VkResult result = realOf(real##name)(device, info, callbacks, out);                                                              \
    current.load()->call({"vk" #name, true, callbacks, VK_NULL_HANDLE, {}}, #kind, result == VK_SUCCESS);                                  \
    return result;                                                                                                                         \
  }
#define RILL_BETWEEN_PIPELINES(name, Info)                                                                                \
  std::atomic<PFN_vk##name> real##name;                                                                                   \
  VKAPI_ATTR VkResult VKAPI_CALL between##name(VkDevice device, VkPipelineCache cache, uint32_t count, const Info* infos, \
                                               const VkAllocationCallbacks* callbacks, VkPipeline* out) {                 \
    const VkResult result = realOf(real##name)(device, cache, count, infos, callbacks, out);                              \
    int64_t made = 0;                                                                                                     \
    for (uint32_t i = 0; i < count; ++i) made += out[i] != VK_NULL_HANDLE;                                                \
    current.load()->call({"vk" #name, true, callbacks, cache, {}}, "Pipeline", made);                                     \
    return result;                                                                                                        \
  }
#define RILL_BETWEEN_END(name, kind)                                                                                   \
  std::atomic<PFN_vk##name> real##name;                                                                                \
  VKAPI_ATTR void VKAPI_CALL between##name(VkDevice device, Vk##kind handle, const VkAllocationCallbacks* callbacks) { \
    realOf(real##name)(device, handle, callbacks);                                                                     \
    current.load()->call({"vk" #name, false, callbacks, VK_NULL_HANDLE, {}}, #kind, handle ? -1 : 0);                  \
  }

template <class Function>
Function realOf(const std::atomic<Function>& function) {
  return function.load();
}

RILL_MAKERS(RILL_BETWEEN)
RILL_PIPELINE_MAKERS(RILL_BETWEEN_PIPELINES)
RILL_DESTROYERS(RILL_BETWEEN_END)

std::atomic<PFN_vkGetDeviceProcAddr> realGetDeviceProcAddr;
std::atomic<PFN_vkGetPhysicalDeviceFeatures2> realGetPhysicalDeviceFeatures2;

VKAPI_ATTR void VKAPI_CALL betweenFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* out) {
  realOf(realGetPhysicalDeviceFeatures2)(device, out);
  const auto lacks = current.load()->lacks;
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext)
    if (lacks && next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES)
      reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(next)->*lacks = VK_FALSE;
}

std::atomic<PFN_vkGetPhysicalDeviceProperties2> realGetPhysicalDeviceProperties2;
VKAPI_ATTR void VKAPI_CALL betweenProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties2* out) {
  realOf(realGetPhysicalDeviceProperties2)(device, out);
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES) {
      auto& subgroup = *reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next);
      subgroup.supportedOperations &= ~current.load()->lacksSubgroups;
      if (const uint32_t lanes = current.load()->lanes) subgroup.subgroupSize = lanes;
    }
}

std::atomic<PFN_vkGetPhysicalDeviceFormatProperties> realGetPhysicalDeviceFormatProperties;
VKAPI_ATTR void VKAPI_CALL betweenFormats(VkPhysicalDevice device, VkFormat format, VkFormatProperties* out) {
  realOf(realGetPhysicalDeviceFormatProperties)(device, format, out);
  if (format == current.load()->lacksTexels) out->bufferFeatures = 0;
}

std::atomic<PFN_vkGetPhysicalDeviceQueueFamilyProperties> realGetPhysicalDeviceQueueFamilyProperties;
VKAPI_ATTR void VKAPI_CALL betweenQueues(VkPhysicalDevice device, uint32_t* count, VkQueueFamilyProperties* out) {
  realOf(realGetPhysicalDeviceQueueFamilyProperties)(device, count, out);
  for (uint32_t i = 0; out && i < *count; ++i) out[i].queueFlags &= ~current.load()->lacksQueues;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL betweenDevice(VkDevice device, const char* name) {
  current.load()->look(name);
  const PFN_vkVoidFunction found = realOf(realGetDeviceProcAddr)(device, name);
#define RILL_ANSWER(function, ...)                                   \
  if (found && std::strcmp(name, "vk" #function) == 0) {             \
    real##function = reinterpret_cast<PFN_vk##function>(found);      \
    return reinterpret_cast<PFN_vkVoidFunction>(&between##function); \
  }
  RILL_MAKERS(RILL_ANSWER)
  RILL_PIPELINE_MAKERS(RILL_ANSWER)
  RILL_DESTROYERS(RILL_ANSWER)
  return found;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL betweenInstance(VkInstance instance, const char* name) {
  current.load()->look(name);
  const PFN_vkVoidFunction found = loaderFunction()(instance, name);
  if (found && std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    realGetDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(&betweenDevice);
  }
#define RILL_INSTEAD(function, between)                         \
  if (found && std::strcmp(name, "vk" #function) == 0) {        \
    real##function = reinterpret_cast<PFN_vk##function>(found); \
    return reinterpret_cast<PFN_vkVoidFunction>(&between);      \
  }
  RILL_INSTEAD(GetPhysicalDeviceFeatures2, betweenFeatures)
  RILL_INSTEAD(GetPhysicalDeviceProperties2, betweenProperties)
  RILL_INSTEAD(GetPhysicalDeviceFormatProperties, betweenFormats)
  RILL_INSTEAD(GetPhysicalDeviceQueueFamilyProperties, betweenQueues)
#undef RILL_INSTEAD
  return found;
}

}  // namespace

Watch::Watch() { current = this; }
Watch::~Watch() { current = nullptr; }

PFN_vkGetInstanceProcAddr Watch::getInstanceProcAddr() { return &betweenInstance; }

std::set<std::string> Watch::lookedUp() {
  const std::lock_guard lock(mutex_);
  return lookedUp_;
}

std::vector<Watch::Call> Watch::calls() {
  const std::lock_guard lock(mutex_);
  return calls_;
}

size_t Watch::made(std::string_view but) {
  size_t count = 0;
  for (const Call& call : calls()) count += call.makes && call.name.find(but) == std::string::npos;
  return count;
}

std::map<std::string, int64_t> Watch::alive() {
  const std::lock_guard lock(mutex_);
  std::map<std::string, int64_t> some = alive_;
  std::erase_if(some, [](const auto& row) { return row.second == 0; });
  return some;
}

void Watch::forget() {
  const std::lock_guard lock(mutex_);
  calls_.clear();
}

void Watch::look(const char* name) {
  const std::lock_guard lock(mutex_);
  lookedUp_.insert(name);
}

void Watch::call(const Call& call, const char* kind, int64_t count) {
  const std::lock_guard lock(mutex_);
  calls_.push_back(call);
  calls_.back().during = doing.load();
  alive_[kind] += count;
}

}  // namespace rill::test
