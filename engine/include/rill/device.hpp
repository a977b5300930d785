#pragma once
// rill::Device: wraps a VkDevice that the host created and owns.
//
//   rill::DeviceRequirements needs;  // before vkCreateDevice
//   if (auto ok = rill::appendRequired(vkGetInstanceProcAddr, instance, physicalDevice, needs); !ok) return fail(ok.error().message);
//   deviceInfo.pNext = needs.chain();
//   auto borrowed = rill::Device::borrow({.instance = instance,  // after vkCreateDevice
//                                         .physicalDevice = physicalDevice,
//                                         .device = vkDevice,
//                                         .queueFamily = queueFamily,
//                                         .getInstanceProcAddr = vkGetInstanceProcAddr,
//                                         .enabled = &needs.features});
//   if (!borrowed) return fail(borrowed.error().message);
//   borrowed->beginFrame({.recording = frameNumber, .completed = lastFinishedFrame});  // every frame
//
// The contract between Rill and its host (tested in tests/contract):
//
// Requirements: Vulkan 1.3 with the features that appendRequired() sets (mandatory in 1.3, but the
// host must enable them); no extension. Compute shaders need subgroups of at least 4 lanes with
// vote, arithmetic and shuffle operations. Uniform texel buffers of R32_UINT, R32G32_UINT,
// R32G32B32A32_UINT and R32G32B32A32_SFLOAT. Workgroups of 256 invocations and 16 storage buffers in a
// compute shader. A queue family with compute, and with graphics if a FluidRenderer or a pass with targets
// is used. Where the host enables shaderMaximalReconvergence or shaderSubgroupUniformControlFlow (and their
// extensions), shaders that shuffle ask for it.
//
// Submission: Rill records into the host's command buffers. It never submits, never waits, and
// creates no instance, device or queue. The host reports completed frames through FrameClock, which
// alone decides when Rill reuses or frees memory.
//
// Allocation: device memory is allocated only inside calls that return an Expected, and freed in
// Device::beginFrame and ~Device. A frame declared like the previous ones allocates no memory and
// creates only views, which live until that frame has completed. Memory comes from
// HostDevice::memory if set, otherwise from vkAllocateMemory.
//
// Ownership: every object is created and destroyed with HostDevice::callbacks, every pipeline is
// created through HostDevice::cache, which the host may save. Rill destroys only what it created, and
// all of it by the end of ~Device.
//
// Threads: a Device and everything created with it may be used by any thread, but by one at a time.
// Rill starts no threads and calls back only from inside a call of the host. Devices borrowed from one
// VkDevice are independent: each may be used by its own thread if callbacks, memory and
// getInstanceProcAddr are thread safe and a shared cache was created without
// VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT.
//
// Errors: calls return an Expected; a graph keeps declaration errors until compile(). The only
// exception that leaves a call is std::bad_alloc. Programming errors are asserts.
//
// Process state: Rill prints nothing, handles no signals and reads no environment variables (except
// RILL_SHADER_DIR in builds with RILL_SHADER_RELOAD). The only global state is the counter that gives
// each graph frame a unique epoch. Warnings that belong to no call go to the message callback.
#include <vulkan/vulkan_core.h>
#ifndef VK_API_VERSION_1_3
#error "Rill needs the Vulkan headers, version 1.3.239 or newer"
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

/// How kernels read arrays that they gather from. The bits are the same.
enum class ArrayReads : uint8_t {
  Auto,     ///< what is faster on devices of this vendor, as far as measurements are known (docs/notes/reading-variant.md)
  Storage,  ///< storage buffers
  Texels    ///< uniform texel buffers, where arrays fit into them
};

/// Handles that Rill borrows. The host keeps them alive until the rill::Device is destroyed and the
/// recorded work has finished. Only Device::borrow reads the structures pointed to, except `callbacks`.
struct HostDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;  ///< family of the queue that the host submits to; compute, plus graphics if passes draw
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< used to look up every Vulkan function
  uint32_t apiVersion = VK_API_VERSION_1_3;                 ///< API version of the instance and the device; at least 1.3
  const VkPhysicalDeviceFeatures2* enabled = nullptr;       ///< feature chain passed to vkCreateDevice (Vulkan has no query for it)
  VkPipelineCache cache = VK_NULL_HANDLE;                   ///< optional
  const VkAllocationCallbacks* callbacks = nullptr;         ///< optional; must live as long as the handles
  const MemoryHooks* memory = nullptr;                      ///< optional; its `user` object must live as long as the handles
  ArrayReads reads = ArrayReads::Auto;
};

/// Features that Rill requires. The host sets further features of these two structures in place, and
/// passes other structures to chain().
struct DeviceRequirements {
  DeviceRequirements() {
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  }
  VkPhysicalDeviceFeatures2 features{};
  VkPhysicalDeviceVulkan13Features vulkan13{};

  /// Links both structures and the host's chain `next`; the result is for VkDeviceCreateInfo::pNext and
  /// HostDevice::enabled. Call it again after a copy, since the links point into the original. `next`
  /// must contain neither structure, nor one that was promoted into Vulkan 1.3.
  RILL_API VkPhysicalDeviceFeatures2* chain(void* next = nullptr);
};

/// Sets the features that Rill requires in `requirements`; clears none. Fails with NoDevice and a line for
/// each version, feature or limit that is missing, with what would help. `getInstanceProcAddr` and `instance`
/// are used only during the call.
RILL_API Expected<void> appendRequired(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkPhysicalDevice physicalDevice,
                                       DeviceRequirements& requirements);

/// The host's frame counters: the frame being recorded and the last frame that the device has finished.
/// They decide when memory is reused or freed. Both only increase; recording > completed.
struct FrameClock {
  uint64_t recording = 1;
  uint64_t completed = 0;
};

/// Properties of the device in use.
struct DeviceInfo {
  std::string name;                ///< as the driver reports it
  std::string driver;              ///< driver name and version
  std::string api;                 ///< "1.3.230"
  uint64_t deviceLocalBytes = 0;   ///< size of the largest device-local heap
  uint64_t maxBufferBytes = 0;     ///< of one buffer: the smallest of maxStorageBufferRange, maxBufferSize and maxMemoryAllocationSize
  std::string_view maxBufferName;  ///< the limit that this is, as Vulkan calls it
  uint32_t maxTexelBufferElements = 0;
  bool texelReads = false;        ///< kernels read arrays through uniform texel buffers
  std::string_view readsBecause;  ///< why they do, or do not
  uint32_t subgroupSize = 0, minSubgroupSize = 0, maxSubgroupSize = 0;
};

/// Receives messages that belong to no call's result (shader reloading). Rill never prints.
using MessageCallback = std::function<void(std::string_view)>;

class DeviceImpl;

/// A borrowed device. It must outlive every module created with it and every graph prepared with it; they remain
/// valid when it is moved. A moved-from Device may only be destroyed or assigned to. Pipelines (rill/pipeline.hpp)
/// live as long as the Device.
class RILL_API Device {
 public:
  /// Fails with BadInput for a null handle or another field that the host can correct, and with NoDevice
  /// and a line for each item if the device lacks something or required features are not enabled.
  static Expected<Device> borrow(const HostDevice& host);
  /// Destroys everything that Rill created. The host must have waited for the recorded work.
  ~Device();
  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;  ///< destroys what the target held, as ~Device

  /// Call once per frame, before the first Graph::prepare. Frees what was retired in frames up to
  /// clock.completed.
  void beginFrame(FrameClock clock);
  /// Call when the recorded command buffer of `frame` will not be submitted. Later frames that are
  /// already recorded must be abandoned too. Lost uploads are repeated by the next declared frame, which
  /// needs a new frame number.
  void abandon(uint64_t frame);

  const DeviceInfo& info() const;  ///< queried by borrow()
  /// Device-local memory that this process may still allocate, in bytes, as the driver says at the moment: VK_EXT_memory_budget.
  /// Without it, or with HostDevice::memory, the size of the largest device-local heap.
  uint64_t availableBytes() const;
  /// Receives warnings such as a failed shader reload, on the thread that calls Rill. Without a callback
  /// they are dropped.
  void setMessageCallback(MessageCallback callback);

 private:
  friend struct ImplAccess;  // engine/core/impl_of.hpp
  explicit Device(std::unique_ptr<DeviceImpl>);
  std::unique_ptr<DeviceImpl> impl_;
};

}  // namespace rill
