#pragma once
// A Vulkan instance, device and queue for programs without their own: capture, bench, tests, the viewer.
// libvulkan is opened at run time, so that a missing loader is an error message.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rill/device.hpp"
#include "rill/graph.hpp"

namespace rill::offline {

struct ContextDesc {
  /// A device's name, a part that no other has (case-insensitive) or its index; empty: the first usable one of findDevices().
  std::string device;
  std::string deviceOrigin = {};  ///< what messages about `device` begin with, for example the option that it comes from; may be empty
  bool validation = false;        ///< VK_LAYER_KHRONOS_validation with synchronization validation; an error if it is not installed
  uint32_t framesInFlight = 2;
  std::vector<const char*> instanceExtensions = {};  ///< e.g. those required by the window system
  std::vector<const char*> deviceExtensions = {};
  std::string applicationName = "rill";
  /// Folder of a file with the pipelines that the driver has compiled; written when the context ends. Empty: none is kept.
  std::filesystem::path pipelineCache = {};
  ArrayReads reads = ArrayReads::Auto;
  /// Whether a queue family can present to the program's windows; devices without one are not chosen. Empty: not required.
  std::function<bool(VkInstance, VkPhysicalDevice, uint32_t queueFamily)> presents = {};
};

/// Binary semaphores of a swapchain, for the viewer.
struct SubmitSemaphores {
  std::span<const VkSemaphoreSubmitInfo> wait = {};
  std::span<const VkSemaphoreSubmitInfo> signal = {};
};

class ContextImpl;

/// Waits for the device and destroys everything on destruction. Users of its rill::Device must be destroyed first. device() stays where it
/// is when a Context is moved; a moved-from one may only be destroyed or assigned to.
class Context {
 public:
  /// BadInput, listing the devices, if none or more than one matches `desc.device`; NoDevice if none is usable.
  static Expected<Context> create(const ContextDesc& desc = {});
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  Device& device();
  const Device& device() const;

  /// Waits for a free command buffer and begins a frame. Frames are numbered from 1.
  Expected<FrameClock> beginFrame();
  /// Records with `record(VkCommandBuffer)` and submits. Calls beginFrame() if needed.
  template <class Record>
  Expected<void> submit(Record&& record, const SubmitSemaphores& semaphores = {}) {
    Expected<VkCommandBuffer> commands = beginCommands();
    if (!commands) return commands.error();
    std::forward<Record>(record)(*commands);
    return endCommands(semaphores);
  }
  /// Compiles, prepares, records and submits a graph as one frame.
  Expected<void> run(Graph& graph);
  /// Waits for all submitted frames; their read-backs and timings are then available.
  Expected<void> wait();
  /// Waits for a submitted frame.
  Expected<void> waitFor(uint64_t frame);

  /// Warnings and errors of the validation layer since the last call.
  std::vector<std::string> takeMessages();

  VkInstance instance() const;
  VkPhysicalDevice physicalDevice() const;
  VkDevice vkDevice() const;
  VkQueue queue() const;
  uint32_t queueFamily() const;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr() const;

 private:
  explicit Context(std::unique_ptr<ContextImpl> impl);
  Expected<VkCommandBuffer> beginCommands();
  Expected<void> endCommands(const SubmitSemaphores& semaphores);
  std::unique_ptr<ContextImpl> impl_;
};

}  // namespace rill::offline
