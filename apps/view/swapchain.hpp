#pragma once
// The swapchain of a window, recreated when the window's size or the present mode changes.
#include <memory>
#include <optional>
#include <vector>

#include "offline/context.hpp"
#include "view/present_mode.hpp"
#include "view/surface_format.hpp"

#define RILL_SWAPCHAIN_INSTANCE_FUNCTIONS(X) \
  X(DestroySurfaceKHR)                       \
  X(GetDeviceProcAddr)                       \
  X(GetPhysicalDeviceSurfaceCapabilitiesKHR) \
  X(GetPhysicalDeviceSurfaceFormatsKHR)      \
  X(GetPhysicalDeviceSurfacePresentModesKHR)

#define RILL_SWAPCHAIN_DEVICE_FUNCTIONS(X) \
  X(AcquireNextImageKHR)                   \
  X(CreateSemaphore)                       \
  X(CreateSwapchainKHR)                    \
  X(DestroySemaphore)                      \
  X(DestroySwapchainKHR)                   \
  X(GetSwapchainImagesKHR)                 \
  X(QueuePresentKHR)                       \
  X(QueueWaitIdle)

namespace rill::view {

class Swapchain {
 public:
  /// A swapchain image between acquire() and present().
  struct Target {
    VkImage image = VK_NULL_HANDLE;
    uint32_t index = 0;
    uint32_t width = 0, height = 0;  ///< pixels
    VkSemaphoreSubmitInfo ready{}, drawn{};
  };

  /// Takes ownership of `surface`. NoDevice where the device cannot present to it, BadInput where the surface lacks the mode.
  static Expected<std::unique_ptr<Swapchain>> create(offline::Context& context, VkSurfaceKHR surface, VkPresentModeKHR mode);
  ~Swapchain();

  const SurfaceFormat& format() const { return format_; }
  /// Creates the images, in this size or the one that the surface requires. Waits for the queue.
  Expected<void> make(uint32_t width, uint32_t height);
  /// nullopt where the swapchain must be recreated, or the window is not visible. A swapchain that is only suboptimal is kept: some
  /// window systems report that for ever, and a changed size is noticed by the window.
  Expected<std::optional<Target>> acquire();
  /// False where the swapchain must be recreated.
  Expected<bool> present(const Target& target);

  /// Those that have a name.
  std::span<const VkPresentModeKHR> modes() const { return modes_; }
  VkPresentModeKHR mode() const { return mode_; }
  void choose(VkPresentModeKHR mode) { mode_ = mode; }  ///< one of modes(); used from the next make() on

 private:
  Swapchain(offline::Context& context, VkSurfaceKHR surface) : context_(context), surface_(surface) {}
  Expected<void> load();
  void destroySemaphores();
  Expected<VkSemaphore> semaphore();

  offline::Context& context_;
  VkSurfaceKHR surface_;
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  SurfaceFormat format_;
  std::vector<VkPresentModeKHR> modes_;
  VkPresentModeKHR mode_ = VK_PRESENT_MODE_FIFO_KHR;
  uint32_t width_ = 0, height_ = 0;
  std::vector<VkImage> images_;
  std::vector<VkSemaphore> drawn_;  ///< one per image: reusable once the image is acquired again
  std::vector<VkSemaphore> ready_;  ///< used in turn; more than there are submits in flight
  size_t turn_ = 0;

#define RILL_DECLARE(name) PFN_vk##name name = nullptr;
  struct {
    RILL_SWAPCHAIN_INSTANCE_FUNCTIONS(RILL_DECLARE)
  } vki_;
  struct {
    RILL_SWAPCHAIN_DEVICE_FUNCTIONS(RILL_DECLARE)
  } vk_;
#undef RILL_DECLARE
};

/// Command buffers of the viewer's context: two displayed frames, each with a piece of a step.
constexpr uint32_t kSubmitsInFlight = 4;

}  // namespace rill::view
