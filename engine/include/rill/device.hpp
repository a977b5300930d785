#pragma once
// A device that a host lends to Rill:
//
//   rill::DeviceRequirements needs;  // before the device is made
//   if (auto ok = rill::appendRequired(vkGetInstanceProcAddr, instance, physicalDevice, needs); !ok) return fail(ok.error().message);
//   deviceInfo.pNext = needs.chain();
//   auto lent = rill::Device::borrow({.instance = instance,  // after it
//                                     .physicalDevice = physicalDevice,
//                                     .device = vkDevice,
//                                     .queueFamily = queueFamily,
//                                     .getInstanceProcAddr = vkGetInstanceProcAddr,
//                                     .enabled = &needs.features});
//   if (!lent) return fail(lent.error().message);
//   (*lent)->beginFrame({.recording = frameNumber, .completed = lastFinishedFrame});  // every frame
//
// What each side can rely on (tested in tests/contract, as far as a program can):
//
// Needed: Vulkan 1.3, those of its features that appendRequired() adds (all mandatory, yet to be enabled), no extension. In compute shaders
// subgroups of 4 lanes or more with arithmetic and shuffle; uniform texel buffers of R32_UINT, R32G32B32A32_UINT and R32G32B32A32_SFLOAT. A
// queue family that computes; one that draws as well where a FluidRenderer, or a pass with targets, is used.
//
// Work: Rill records into the host's command buffers. It never submits, never waits and makes no instance, device or queue. The host tells
// by FrameClock what has completed; that alone decides when Rill uses memory again or frees it.
//
// Allocation: device memory is allocated inside calls that return an Expected, and freed in Device::beginFrame and ~Device. A frame
// declared like those before it allocates none, and makes nothing but views, which live until their frame has completed. Memory comes from
// HostDevice::memory where there is one, else from vkAllocateMemory.
//
// The host's own: each object is made and destroyed with HostDevice::callbacks, each pipeline through HostDevice::cache, which the host may
// save. Rill destroys nothing that it did not make, and all that it did by the end of ~Device.
//
// Threads: a Device and all that was made with it are used by one thread at a time, whichever that is. Rill starts none and calls the host
// back only from inside a call of the host's. Devices borrowed from one VkDevice know nothing of each other: each may have its own thread,
// if callbacks, memory and getInstanceProcAddr are safe there, and a shared cache was not made with
// VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT.
//
// Errors: an Expected says what went wrong; a graph keeps what was declared wrongly for compile(). No exception leaves a call, but
// std::bad_alloc where host memory has run out. What only wrong code can do is an assert, in builds that have them.
//
// Silence: nothing is printed, no signal handled, no environment read (but RILL_SHADER_DIR in builds with RILL_SHADER_RELOAD), and there is
// no global state but a counter by which graphs tell their refs apart. What is nobody's result goes to the message callback.
#include <vulkan/vulkan_core.h>
#ifndef VK_API_VERSION_1_3
#error "Rill needs Vulkan's headers of version 1.3.239 or newer"
#endif

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/memory.hpp"

namespace rill {

/// Handles that Rill borrows from its host, which keeps them alive until the rill::Device is gone and the work recorded through it has
/// finished. The structures that it points to are read in Device::borrow alone, but for `callbacks`.
struct HostDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;  ///< of the queue that recorded work goes to; compute, and graphics where passes draw
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< where every Vulkan function is looked up
  uint32_t apiVersion = VK_API_VERSION_1_3;                 ///< that the instance and device were made with
  const VkPhysicalDeviceFeatures2* enabled = nullptr;  ///< features enabled at vkCreateDevice, with their chain (a VkDevice can't be asked)
  VkPipelineCache cache = VK_NULL_HANDLE;              ///< optional
  const VkAllocationCallbacks* callbacks = nullptr;    ///< optional; lives as long as the handles
  const MemoryHooks* memory = nullptr;                 ///< optional; what its `user` points to lives as long as the handles
};

/// What Rill needs of a device. What the host wants of these two structures itself is set in them, of others chained on.
struct DeviceRequirements {
  DeviceRequirements() {
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  }
  VkPhysicalDeviceFeatures2 features{};
  VkPhysicalDeviceVulkan13Features vulkan13{};

  /// Links both and `next`, a chain of the host's, for VkDeviceCreateInfo::pNext and HostDevice::enabled. Once more after a copy: links
  /// point into the one that they were made for. `next` has neither of the two, nor what Vulkan 1.3 was put together from.
  RILL_API VkPhysicalDeviceFeatures2* chain(void* next = nullptr);
};

/// Adds the features that Rill requires to `requirements`, and takes none away. NoDevice, naming the missing feature or version, where the
/// physical device lacks one. `getInstanceProcAddr` and `instance` are used for the query alone.
RILL_API Expected<void> appendRequired(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkPhysicalDevice physicalDevice,
                                       DeviceRequirements& requirements);

/// The host's frame counters: the frame now being recorded and the last one whose work the device has finished.
/// They drive all retirement of memory. Both only rise; recording > completed.
struct FrameClock {
  uint64_t recording = 1;
  uint64_t completed = 0;
};

/// Properties of the device in use.
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

/// Rill's view of a borrowed device. Every module and every graph that was prepared keeps a reference to it: it outlives them. Pipelines
/// (rill/pipeline.hpp) live as long as it.
class RILL_API Device {
 public:
  /// BadInput for a null handle or what else the host can put right, NoDevice where a required feature was not enabled (it is named).
  static Expected<std::unique_ptr<Device>> borrow(const HostDevice& host);
  /// Destroys what Rill made: the host has waited for its work before.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Once before a frame's graph is prepared. What was retired in frames up to clock.completed is freed here.
  void beginFrame(FrameClock clock);
  /// A recorded command buffer of this frame will not be submitted. Those of later frames that are recorded already will not be either:
  /// called for each of them. What it was to upload is uploaded by the next one that is declared, which has a number of its own.
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
