#include "view/swapchain.hpp"

#include <algorithm>

#include "gpu/vulkan_error.hpp"

namespace rill::view {
namespace {

constexpr uint64_t kAcquireTimeout = 1'000'000'000;  // ns; the compositor returns no images of an invisible window

VkSemaphoreSubmitInfo submitInfo(VkSemaphore semaphore, VkPipelineStageFlags2 stages) {
  VkSemaphoreSubmitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  info.semaphore = semaphore;
  info.stageMask = stages;
  return info;
}

}  // namespace

Expected<std::unique_ptr<Swapchain>> Swapchain::create(offline::Context& context, VkSurfaceKHR surface, VkPresentModeKHR mode) {
  std::unique_ptr<Swapchain> made(new Swapchain(context, surface));
  if (auto ok = made->load(); !ok) return ok.error();
  const VkPhysicalDevice device = context.physicalDevice();
  uint32_t count = 0;
  if (VkResult r = made->vki_.GetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr); r != VK_SUCCESS)
    return vulkanError(r, "querying the window's formats");
  std::vector<VkSurfaceFormatKHR> formats(count);
  (void)made->vki_.GetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data());
  const auto format = chooseSurfaceFormat(formats);
  if (!format) return format.error();
  made->format_ = *format;
  if (VkResult r = made->vki_.GetPhysicalDeviceSurfacePresentModesKHR(device, surface, &count, nullptr); r != VK_SUCCESS)
    return vulkanError(r, "querying the window's present modes");
  made->modes_.resize(count);
  if (VkResult r = made->vki_.GetPhysicalDeviceSurfacePresentModesKHR(device, surface, &count, made->modes_.data());
      r != VK_SUCCESS && r != VK_INCOMPLETE)
    return vulkanError(r, "querying the window's present modes");
  made->modes_.resize(count);
  std::erase_if(made->modes_, [](VkPresentModeKHR other) { return presentModeName(other).empty(); });
  if (auto offered = checkPresentMode(mode, made->modes_); !offered) return offered.error();
  made->mode_ = mode;
  for (uint32_t k = 0; k <= kSubmitsInFlight; ++k) {
    auto ready = made->semaphore();
    if (!ready) return ready.error();
    made->ready_.push_back(*ready);
  }
  return made;
}

Expected<void> Swapchain::load() {
  const auto get = context_.getInstanceProcAddr();
#define RILL_LOAD(name)                                                             \
  vki_.name = reinterpret_cast<PFN_vk##name>(get(context_.instance(), "vk" #name)); \
  if (!vki_.name) return Error{ErrorKind::NoDevice, "the Vulkan instance lacks vk" #name};
  RILL_SWAPCHAIN_INSTANCE_FUNCTIONS(RILL_LOAD)
#undef RILL_LOAD
#define RILL_LOAD(name)                                                                               \
  vk_.name = reinterpret_cast<PFN_vk##name>(vki_.GetDeviceProcAddr(context_.vkDevice(), "vk" #name)); \
  if (!vk_.name) return Error{ErrorKind::NoDevice, "the Vulkan device lacks vk" #name};
  RILL_SWAPCHAIN_DEVICE_FUNCTIONS(RILL_LOAD)
#undef RILL_LOAD
  return {};
}

Expected<VkSemaphore> Swapchain::semaphore() {
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore made = VK_NULL_HANDLE;
  if (VkResult r = vk_.CreateSemaphore(context_.vkDevice(), &info, nullptr, &made); r != VK_SUCCESS)
    return vulkanError(r, "creating a semaphore");
  return made;
}

Swapchain::~Swapchain() {
  if (vk_.QueueWaitIdle) (void)vk_.QueueWaitIdle(context_.queue());  // also for a lost device
  for (const VkSemaphore ready : ready_) vk_.DestroySemaphore(context_.vkDevice(), ready, nullptr);
  destroySemaphores();
  if (swapchain_) vk_.DestroySwapchainKHR(context_.vkDevice(), swapchain_, nullptr);
  if (vki_.DestroySurfaceKHR) vki_.DestroySurfaceKHR(context_.instance(), surface_, nullptr);
}

void Swapchain::destroySemaphores() {
  for (const VkSemaphore drawn : drawn_) vk_.DestroySemaphore(context_.vkDevice(), drawn, nullptr);
  drawn_.clear();
}

Expected<void> Swapchain::make(uint32_t width, uint32_t height) {
  if (VkResult r = vk_.QueueWaitIdle(context_.queue()); r != VK_SUCCESS) return vulkanError(r, "waiting for the window's last frame");
  VkSurfaceCapabilitiesKHR can{};
  if (VkResult r = vki_.GetPhysicalDeviceSurfaceCapabilitiesKHR(context_.physicalDevice(), surface_, &can); r != VK_SUCCESS)
    return vulkanError(r, "querying the window's size");
  if (can.currentExtent.width != UINT32_MAX) {
    width = can.currentExtent.width;
    height = can.currentExtent.height;
  } else {
    width = std::clamp(width, can.minImageExtent.width, can.maxImageExtent.width);
    height = std::clamp(height, can.minImageExtent.height, can.maxImageExtent.height);
  }
  width_ = width;
  height_ = height;
  VkSwapchainKHR old = std::exchange(swapchain_, VK_NULL_HANDLE);
  VkResult r = VK_SUCCESS;
  if (width > 0 && height > 0) {
    VkSwapchainCreateInfoKHR create{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    create.surface = surface_;
    create.minImageCount = std::max(can.minImageCount, can.maxImageCount == 0 ? 3u : std::min(3u, can.maxImageCount));
    create.imageFormat = format_.format;
    create.imageColorSpace = format_.space;
    create.imageExtent = {width, height};
    create.imageArrayLayers = 1;
    create.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    create.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    create.preTransform = can.currentTransform;
    create.compositeAlpha = can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                                            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    create.presentMode = mode_;
    create.clipped = VK_TRUE;
    create.oldSwapchain = old;
    r = vk_.CreateSwapchainKHR(context_.vkDevice(), &create, nullptr, &swapchain_);
  }
  if (old) vk_.DestroySwapchainKHR(context_.vkDevice(), old, nullptr);
  destroySemaphores();
  images_.clear();
  if (r != VK_SUCCESS)
    return vulkanError(r, "creating the swapchain of a window of " + std::to_string(width) + "x" + std::to_string(height));
  if (!swapchain_) return {};
  uint32_t count = 0;
  (void)vk_.GetSwapchainImagesKHR(context_.vkDevice(), swapchain_, &count, nullptr);
  images_.resize(count);
  if (r = vk_.GetSwapchainImagesKHR(context_.vkDevice(), swapchain_, &count, images_.data()); r != VK_SUCCESS)
    return vulkanError(r, "getting the window's images");
  for (uint32_t k = 0; k < count; ++k) {
    auto drawn = semaphore();
    if (!drawn) return drawn.error();
    drawn_.push_back(*drawn);
  }
  return {};
}

Expected<std::optional<Swapchain::Target>> Swapchain::acquire() {
  if (!swapchain_) return std::optional<Target>();
  Target target;
  const VkSemaphore ready = ready_[turn_];
  const VkResult r = vk_.AcquireNextImageKHR(context_.vkDevice(), swapchain_, kAcquireTimeout, ready, VK_NULL_HANDLE, &target.index);
  if (r == VK_ERROR_OUT_OF_DATE_KHR || r == VK_TIMEOUT || r == VK_NOT_READY) return std::optional<Target>();
  if (r != VK_SUCCESS && r != VK_SUBOPTIMAL_KHR) return vulkanError(r, "getting an image of the window");
  turn_ = (turn_ + 1) % ready_.size();
  target.image = images_[target.index];
  target.width = width_;
  target.height = height_;
  target.ready = submitInfo(ready, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
  target.drawn = submitInfo(drawn_[target.index], VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  return std::optional(target);
}

Expected<bool> Swapchain::present(const Target& target) {
  VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &target.drawn.semaphore;
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain_;
  info.pImageIndices = &target.index;
  const VkResult r = vk_.QueuePresentKHR(context_.queue(), &info);
  if (r == VK_ERROR_OUT_OF_DATE_KHR) return false;
  if (r != VK_SUCCESS && r != VK_SUBOPTIMAL_KHR) return vulkanError(r, "showing a frame");
  return true;
}

}  // namespace rill::view
