#pragma once
// A Vulkan instance, device and queue of our own, for programs that have none to lend: capture, bench, tests, the viewer.
// No loader is linked: libvulkan is opened at run time, so that a program without it can say so.
#include <cstdint>
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
  std::string device;       ///< part of a device's name (case ignored) or its index; empty: the most capable kind there is
  bool validation = false;  ///< VK_LAYER_KHRONOS_validation with synchronization validation; an error where it is not installed
  uint32_t framesInFlight = 2;
  std::vector<const char*> instanceExtensions = {};  ///< e.g. those that a window system asks for
  std::vector<const char*> deviceExtensions = {};
  std::string applicationName = "rill";
  /// Whether a queue family can show pictures in the program's windows; devices without such a family are not chosen. Empty: any will do.
  std::function<bool(VkInstance, VkPhysicalDevice, uint32_t queueFamily)> presents = {};
};

/// Binary semaphores of a swapchain, for the viewer.
struct SubmitSemaphores {
  std::span<const VkSemaphoreSubmitInfo> wait = {};
  std::span<const VkSemaphoreSubmitInfo> signal = {};
};

class ContextImpl;

/// Destroys everything that it made, after waiting for the device; what uses its rill::Device goes first.
class Context {
 public:
  /// BadInput, listing the devices, where none matches `desc.device`; NoDevice where no usable one exists.
  static Expected<std::unique_ptr<Context>> create(const ContextDesc& desc = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  Device& device();

  /// Waits until a command buffer is free and tells the device that a frame begins. Frames are numbered from 1.
  Expected<FrameClock> beginFrame();
  /// Records with `record(VkCommandBuffer)` and submits. Begins a frame if none has begun.
  template <class Record>
  Expected<void> submit(Record&& record, const SubmitSemaphores& semaphores = {}) {
    Expected<VkCommandBuffer> commands = beginCommands();
    if (!commands) return commands.error();
    std::forward<Record>(record)(*commands);
    return endCommands(semaphores);
  }
  /// Compiles, prepares, records and submits a graph as one frame.
  Expected<void> run(Graph& graph);
  /// Waits for everything submitted. Read-backs and timings of those frames are there afterwards.
  Expected<void> wait();
  /// Waits until this submitted frame is finished.
  Expected<void> waitFor(uint64_t frame);
  /// Waits until at most `frames` submitted frames are unfinished.
  Expected<void> waitUntilInFlight(uint32_t frames);

  /// What the validation layer said (warnings and errors) since the last call.
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
