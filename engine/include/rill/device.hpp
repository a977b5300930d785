#pragma once
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"

namespace rill {

/// Handles that Rill borrows from its host. Rill never destroys them, never submits to a queue and never waits.
/// The host keeps them alive until the rill::Device is gone and the work recorded through it has finished.
struct HostDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;  ///< of the queue that recorded work goes to; compute, and graphics where passes draw
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< where every Vulkan function is looked up
  uint32_t apiVersion = VK_API_VERSION_1_3;                 ///< that the instance and device were made with
  const VkPhysicalDeviceFeatures2* enabled = nullptr;  ///< features enabled at vkCreateDevice, with their chain (a VkDevice can't be asked)
  std::span<const char* const> extensions = {};        ///< extensions enabled at vkCreateDevice
  VkPipelineCache cache = VK_NULL_HANDLE;              ///< optional
  const VkAllocationCallbacks* callbacks = nullptr;    ///< optional
};

/// What Rill needs of a device, to be put into the host's VkDeviceCreateInfo.
struct DeviceRequirements {
  DeviceRequirements() {
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  }
  VkPhysicalDeviceFeatures core{};
  VkPhysicalDeviceVulkan12Features vulkan12{};
  VkPhysicalDeviceVulkan13Features vulkan13{};
};

/// Adds the features that Rill requires to `requirements`. NoDevice, naming the missing feature or version, where the
/// physical device lacks one. `getInstanceProcAddr` and `instance` are used for the query alone.
RILL_API Expected<void> appendRequired(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkPhysicalDevice physicalDevice,
                                       DeviceRequirements& requirements);

/// The host's frame counters: the frame now being recorded and the last one whose work the device has finished.
/// They drive all retirement of memory. Both only rise; recording > completed.
struct FrameClock {
  uint64_t recording = 1;
  uint64_t completed = 0;
};

struct DeviceInfo {
  std::string name;                    ///< as the driver reports it
  std::string driver;                  ///< driver name and version
  std::string api;                     ///< "1.3.230"
  uint64_t deviceLocalBytes = 0;       ///< size of the largest device-local heap
  uint64_t maxStorageBufferBytes = 0;  ///< maxStorageBufferRange, at most 128 MiB is used by Rill
  uint32_t maxTexelBufferElements = 0;
  uint32_t subgroupSize = 0, minSubgroupSize = 0, maxSubgroupSize = 0;
};

/// Receives what Rill has to say outside a call's result (shader reloading). Rill itself never prints.
using MessageCallback = std::function<void(std::string_view)>;

class DeviceImpl;

/// Rill's view of a borrowed device. Every module keeps a reference to it; it outlives them.
/// Not thread safe: one thread at a time.
class RILL_API Device {
 public:
  /// BadInput for a null handle, NoDevice where a required feature was not enabled (it is named).
  static Expected<std::unique_ptr<Device>> borrow(const HostDevice& host);
  /// Destroys what Rill made: the host has waited for its work before.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Once before a frame's graph is prepared. What was retired in frames up to clock.completed is freed here.
  void beginFrame(FrameClock clock);
  /// A recorded command buffer of this frame will not be submitted.
  void abandon(uint64_t frame);

  const DeviceInfo& info() const;  ///< what was found out when it was borrowed
  /// Where warnings go that are nobody's result (a shader that did not reload). Called by the thread that calls Rill; none: they are
  /// dropped.
  void setMessageCallback(MessageCallback callback);

  DeviceImpl& impl() { return *impl_; }  ///< engine/gpu; not for hosts

 private:
  explicit Device(std::unique_ptr<DeviceImpl>);
  std::unique_ptr<DeviceImpl> impl_;
};

}  // namespace rill
