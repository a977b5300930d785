#pragma once
// Someone else's engine: an instance and a device with what Rill asks for and nothing besides, and a queue to which it alone submits.
// Validation and synchronization validation listen.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "contract/watch.hpp"
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
  /// Null, with a failure of the test, where there is no device. `without`: a required feature to leave out.
  static std::unique_ptr<Host> open(VkBool32 VkPhysicalDeviceVulkan13Features::*without = nullptr);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// With `watch` between; a test may change what it lends.
  HostDevice lend();
  /// Submits what `record` records and waits for it; or throws it away. From any thread.
  void run(const std::function<void(VkCommandBuffer)>& record, bool submits = true);
  std::vector<std::string> takeMessages();

  Watch watch;
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
