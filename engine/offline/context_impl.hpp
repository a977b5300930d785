#pragma once
// Implementation of offline::Context: vulkan_setup.cpp creates instance and device, context.cpp runs frames.
#include <optional>

#include "offline/context.hpp"
#include "offline/pipeline_cache.hpp"

#define RILL_CONTEXT_INSTANCE_FUNCTIONS(X) \
  X(CreateDevice)                          \
  X(DestroyInstance)                       \
  X(EnumerateDeviceExtensionProperties)    \
  X(EnumeratePhysicalDevices)              \
  X(GetDeviceProcAddr)                     \
  X(GetPhysicalDeviceFeatures2)            \
  X(GetPhysicalDeviceProperties)           \
  X(GetPhysicalDeviceQueueFamilyProperties)

#define RILL_CONTEXT_DEVICE_FUNCTIONS(X) \
  X(AllocateCommandBuffers)              \
  X(BeginCommandBuffer)                  \
  X(CreateCommandPool)                   \
  X(CreatePipelineCache)                 \
  X(CreateSemaphore)                     \
  X(DestroyCommandPool)                  \
  X(DestroyDevice)                       \
  X(DestroyPipelineCache)                \
  X(DestroySemaphore)                    \
  X(DeviceWaitIdle)                      \
  X(EndCommandBuffer)                    \
  X(GetDeviceQueue)                      \
  X(GetPipelineCacheData)                \
  X(GetSemaphoreCounterValue)            \
  X(QueueSubmit2)                        \
  X(ResetCommandBuffer)                  \
  X(WaitSemaphores)

namespace rill::offline {

class ContextImpl {
 public:
  ~ContextImpl();

  // vulkan_setup.cpp
  Expected<void> openLoader();
  Expected<void> makeInstance(const ContextDesc& desc);
  Expected<void> chooseDevice(const ContextDesc& desc);
  /// The preferred queue family: one with graphics, if available. Empty if none supports compute, or presentation if required.
  std::optional<uint32_t> familyOf(VkPhysicalDevice handle, const ContextDesc& desc) const;
  /// All devices of the instance; empty where no driver has one.
  Expected<std::vector<VkPhysicalDevice>> physicalDevices() const;
  /// NoDevice, with the device's name and the reason, if it cannot be used with `desc`.
  Expected<void> usable(VkPhysicalDevice handle, const ContextDesc& desc) const;
  bool offers(const char* extension, void* features) const;
  /// The version of Vulkan that the installed validation layer knows; 0 if none is installed.
  uint32_t validatedVersion() const;
  Expected<void> makeDevice(const ContextDesc& desc);
  // context.cpp
  Expected<void> makeFrames(uint32_t count);
  Expected<void> waitFor(uint64_t frame);
  Expected<void> updateCompleted();

  PFN_vkGetInstanceProcAddr get = nullptr;
  PFN_vkCreateInstance createInstance = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  std::string deviceName;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;
  std::optional<PipelineCache> pipelines;
  std::optional<Device> rill;

  VkCommandPool pool = VK_NULL_HANDLE;
  std::vector<VkCommandBuffer> commandBuffers;
  VkSemaphore timeline = VK_NULL_HANDLE;  ///< its value is the last completed frame
  uint64_t submitted = 0;
  uint64_t completed = 0;
  bool begun = false;

  std::mutex messagesMutex;  // layers may call back from other threads
  std::vector<std::string> messages;

#define RILL_DECLARE(name) PFN_vk##name name = nullptr;
  struct {
    RILL_CONTEXT_INSTANCE_FUNCTIONS(RILL_DECLARE)
  } vki;
  struct {
    RILL_CONTEXT_DEVICE_FUNCTIONS(RILL_DECLARE)
  } vk;
#undef RILL_DECLARE
};

}  // namespace rill::offline
