#pragma once
// A host application: an instance, a device with exactly the features that Rill requires, and a queue that
// only the host submits to. Validation and synchronization validation are enabled.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "contract/interceptor.hpp"
#include "rill/device.hpp"

namespace rill::test {

#define RILL_HOST_INSTANCE_FUNCTIONS(X) \
  X(CreateDebugUtilsMessengerEXT)       \
  X(CreateDevice)                       \
  X(DestroyDebugUtilsMessengerEXT)      \
  X(DestroyInstance)                    \
  X(EnumeratePhysicalDevices)           \
  X(GetDeviceProcAddr)                  \
  X(GetPhysicalDeviceMemoryProperties)  \
  X(GetPhysicalDeviceQueueFamilyProperties)

#define RILL_HOST_DEVICE_FUNCTIONS(X) \
  X(AllocateCommandBuffers)           \
  X(AllocateMemory)                   \
  X(BeginCommandBuffer)               \
  X(CreateCommandPool)                \
  X(CreateFence)                      \
  X(CreatePipelineCache)              \
  X(DestroyCommandPool)               \
  X(DestroyDevice)                    \
  X(DestroyFence)                     \
  X(DestroyPipelineCache)             \
  X(EndCommandBuffer)                 \
  X(FreeMemory)                       \
  X(GetDeviceQueue)                   \
  X(GetPipelineCacheData)             \
  X(MapMemory)                        \
  X(QueueSubmit)                      \
  X(WaitForFences)

class Host {
 public:
  /// Null, with a test failure, if there is no device. `without`: a required feature to disable.
  static std::unique_ptr<Host> open(VkBool32 VkPhysicalDeviceVulkan13Features::*without = nullptr);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// The handles for Device::borrow, with `interceptor` as the function loader.
  HostDevice hostDevice();
  /// Records commands, then submits them and waits, or discards them. Thread safe.
  void run(const std::function<void(VkCommandBuffer)>& record, bool submits = true);
  std::vector<std::string> takeMessages();

  Interceptor interceptor;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  uint32_t family = 0;
  DeviceRequirements needs;

#define RILL_DECLARE(name) PFN_vk##name name = nullptr;
  struct {
    RILL_HOST_INSTANCE_FUNCTIONS(RILL_DECLARE)
  } vki;
  struct {
    RILL_HOST_DEVICE_FUNCTIONS(RILL_DECLARE)
  } vk;
#undef RILL_DECLARE

 private:
  Host() = default;
  bool makeInstance();
  bool makeDevice(VkBool32 VkPhysicalDeviceVulkan13Features::*without);
  static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queueMutex_, messagesMutex_;
  std::vector<std::string> messages_;
};

}  // namespace rill::test
