#include "contract/interceptor.hpp"

#include <cstring>

#include "contract/loader.hpp"

namespace rill::test {
namespace {

std::atomic<Interceptor*> current = nullptr;

// Function, type of the created object, create info.
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

#define RILL_INTERCEPT(name, kind, Info)                                                                                    \
  std::atomic<PFN_vk##name> real##name;                                                                                     \
  VKAPI_ATTR VkResult VKAPI_CALL intercept##name(VkDevice device, const Info* info, const VkAllocationCallbacks* callbacks, \
                                                 Vk##kind* out) {                                                           \
    const VkResult result = realOf(real##name)(device, info, callbacks, out);                                               \
    current.load()->onCall({"vk" #name, true, callbacks, VK_NULL_HANDLE, {}}, #kind, result == VK_SUCCESS);                 \
    return result;                                                                                                          \
  }
#define RILL_INTERCEPT_PIPELINES(name, Info)                                                                                \
  std::atomic<PFN_vk##name> real##name;                                                                                     \
  VKAPI_ATTR VkResult VKAPI_CALL intercept##name(VkDevice device, VkPipelineCache cache, uint32_t count, const Info* infos, \
                                                 const VkAllocationCallbacks* callbacks, VkPipeline* out) {                 \
    const VkResult result = realOf(real##name)(device, cache, count, infos, callbacks, out);                                \
    int64_t made = 0;                                                                                                       \
    for (uint32_t i = 0; i < count; ++i) made += out[i] != VK_NULL_HANDLE;                                                  \
    current.load()->onCall({"vk" #name, true, callbacks, cache, {}}, "Pipeline", made);                                     \
    return result;                                                                                                          \
  }
#define RILL_INTERCEPT_DESTROY(name, kind)                                                                               \
  std::atomic<PFN_vk##name> real##name;                                                                                  \
  VKAPI_ATTR void VKAPI_CALL intercept##name(VkDevice device, Vk##kind handle, const VkAllocationCallbacks* callbacks) { \
    realOf(real##name)(device, handle, callbacks);                                                                       \
    current.load()->onCall({"vk" #name, false, callbacks, VK_NULL_HANDLE, {}}, #kind, handle ? -1 : 0);                  \
  }

template <class Function>
Function realOf(const std::atomic<Function>& function) {
  return function.load();
}

RILL_MAKERS(RILL_INTERCEPT)
RILL_PIPELINE_MAKERS(RILL_INTERCEPT_PIPELINES)
RILL_DESTROYERS(RILL_INTERCEPT_DESTROY)

std::atomic<PFN_vkGetDeviceProcAddr> realGetDeviceProcAddr;
std::atomic<PFN_vkGetPhysicalDeviceFeatures2> realGetPhysicalDeviceFeatures2;

VKAPI_ATTR void VKAPI_CALL interceptFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* out) {
  realOf(realGetPhysicalDeviceFeatures2)(device, out);
  const auto lacks = current.load()->missingFeature;
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext)
    if (lacks && next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES)
      reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(next)->*lacks = VK_FALSE;
}

std::atomic<PFN_vkGetPhysicalDeviceProperties2> realGetPhysicalDeviceProperties2;
VKAPI_ATTR void VKAPI_CALL interceptProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties2* out) {
  realOf(realGetPhysicalDeviceProperties2)(device, out);
  for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES) {
      auto& subgroup = *reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next);
      subgroup.supportedOperations &= ~current.load()->missingSubgroupOperations;
      if (const uint32_t subgroupSize = current.load()->subgroupSize) subgroup.subgroupSize = subgroupSize;
    }
}

std::atomic<PFN_vkGetPhysicalDeviceFormatProperties> realGetPhysicalDeviceFormatProperties;
VKAPI_ATTR void VKAPI_CALL interceptFormats(VkPhysicalDevice device, VkFormat format, VkFormatProperties* out) {
  realOf(realGetPhysicalDeviceFormatProperties)(device, format, out);
  if (format == current.load()->missingTexelFormat) out->bufferFeatures = 0;
}

std::atomic<PFN_vkGetPhysicalDeviceQueueFamilyProperties> realGetPhysicalDeviceQueueFamilyProperties;
VKAPI_ATTR void VKAPI_CALL interceptQueues(VkPhysicalDevice device, uint32_t* count, VkQueueFamilyProperties* out) {
  realOf(realGetPhysicalDeviceQueueFamilyProperties)(device, count, out);
  for (uint32_t i = 0; out && i < *count; ++i) out[i].queueFlags &= ~current.load()->missingQueueFlags;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL interceptDevice(VkDevice device, const char* name) {
  current.load()->onLookup(name);
  const PFN_vkVoidFunction found = realOf(realGetDeviceProcAddr)(device, name);
#define RILL_RETURN_INTERCEPTED(function, ...)                         \
  if (found && std::strcmp(name, "vk" #function) == 0) {               \
    real##function = reinterpret_cast<PFN_vk##function>(found);        \
    return reinterpret_cast<PFN_vkVoidFunction>(&intercept##function); \
  }
  RILL_MAKERS(RILL_RETURN_INTERCEPTED)
  RILL_PIPELINE_MAKERS(RILL_RETURN_INTERCEPTED)
  RILL_DESTROYERS(RILL_RETURN_INTERCEPTED)
  return found;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL interceptInstance(VkInstance instance, const char* name) {
  current.load()->onLookup(name);
  const PFN_vkVoidFunction found = loaderFunction()(instance, name);
  if (found && std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    realGetDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(&interceptDevice);
  }
#define RILL_RETURN(function, between)                          \
  if (found && std::strcmp(name, "vk" #function) == 0) {        \
    real##function = reinterpret_cast<PFN_vk##function>(found); \
    return reinterpret_cast<PFN_vkVoidFunction>(&between);      \
  }
  RILL_RETURN(GetPhysicalDeviceFeatures2, interceptFeatures)
  RILL_RETURN(GetPhysicalDeviceProperties2, interceptProperties)
  RILL_RETURN(GetPhysicalDeviceFormatProperties, interceptFormats)
  RILL_RETURN(GetPhysicalDeviceQueueFamilyProperties, interceptQueues)
#undef RILL_RETURN
  return found;
}

}  // namespace

Interceptor::Interceptor() { current = this; }
Interceptor::~Interceptor() { current = nullptr; }

PFN_vkGetInstanceProcAddr Interceptor::getInstanceProcAddr() { return &interceptInstance; }

std::set<std::string> Interceptor::lookedUp() {
  const std::lock_guard lock(mutex_);
  return lookedUp_;
}

std::vector<Interceptor::Call> Interceptor::calls() {
  const std::lock_guard lock(mutex_);
  return calls_;
}

size_t Interceptor::createCount(std::string_view but) {
  size_t count = 0;
  for (const Call& call : calls()) count += call.makes && call.name.find(but) == std::string::npos;
  return count;
}

std::map<std::string, int64_t> Interceptor::liveObjects() {
  const std::lock_guard lock(mutex_);
  std::map<std::string, int64_t> some = liveObjects_;
  std::erase_if(some, [](const auto& row) { return row.second == 0; });
  return some;
}

void Interceptor::clearCalls() {
  const std::lock_guard lock(mutex_);
  calls_.clear();
}

void Interceptor::onLookup(const char* name) {
  const std::lock_guard lock(mutex_);
  lookedUp_.insert(name);
}

void Interceptor::onCall(const Call& call, const char* kind, int64_t count) {
  const std::lock_guard lock(mutex_);
  calls_.push_back(call);
  calls_.back().during = currentCall.load();
  liveObjects_[kind] += count;
}

}  // namespace rill::test
