#include "view/graphics.hpp"

#include <algorithm>

#include "shared/pipeline_cache_folder.hpp"
#include "view/log_error.hpp"

namespace rill::view {

Graphics::Graphics(const Options& options, Window& window, ImFontAtlas& fonts)
    : options_(options), window_(window), fonts_(fonts), mode_(options.present) {}

offline::ContextDesc Graphics::contextDesc(const std::string& device) const {
  offline::ContextDesc desc;
  desc.device = device;
  if (device == options_.device.name) desc.deviceOrigin = options_.device.origin;
  desc.pipelineCache = apps::pipelineCacheFolder();
  desc.validation = options_.validate;
  desc.framesInFlight = kSubmitsInFlight;
  desc.instanceExtensions = Window::instanceExtensions();
  desc.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  desc.applicationName = "rill-view";
  desc.presents = Window::presents;
  return desc;
}

Expected<void> Graphics::create(const std::string& device, VkPresentModeKHR mode) {
  auto context = offline::Context::create(contextDesc(device));
  if (!context) {
    Error error = context.error();
    if (error.kind == ErrorKind::NoDevice) error.message += "\nrill-capture needs no window: it writes images to files";
    return error;
  }
  context_ = std::move(*context);
  const DeviceInfo& info = context_->device().info();
  deviceName_ = info.name + ", " + info.driver;
  meter_.emplace(*context_);
  auto display = Display::create(*context_, window_, fonts_, mode);
  if (!display) return display.error();
  display_ = std::move(*display);
  return {};
}

Expected<void> Graphics::open() {
  if (auto created = create(options_.device.name, mode_); !created) return created;
  if (auto listed = offline::findDevices(contextDesc({}))) devices_ = std::move(*listed);
  return {};
}

Expected<void> Graphics::reopen(const std::string& device) {
  if (auto created = create(device, VK_PRESENT_MODE_FIFO_KHR); !created) return created;  // every device offers this mode
  if (std::ranges::find(display_->modes(), mode_) != display_->modes().end()) display_->choose(mode_);
  return {};
}

void Graphics::close() {
  display_.reset();
  meter_.reset();
  context_.reset();
}

void Graphics::choose(VkPresentModeKHR mode) {
  mode_ = mode;
  display_->choose(mode);
}

void Graphics::logValidationMessages() {
  if (!context_) return;  // no device could be opened
  for (const std::string& message : context_->takeMessages()) {
    logError(message);
    sawValidationMessage_ = true;
  }
}

}  // namespace rill::view
