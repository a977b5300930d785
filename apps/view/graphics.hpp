#pragma once
// The Vulkan device that the viewer runs on, and what it draws the window with.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "offline/device_list.hpp"
#include "view/display.hpp"
#include "view/memory_meter.hpp"
#include "view/options.hpp"

namespace rill::view {

class Graphics {
 public:
  /// `window` and `fonts` must outlive it.
  Graphics(const Options& options, Window& window, ImFontAtlas& fonts);

  /// Opens the device of the options, and a swapchain with their present mode.
  Expected<void> open();
  /// Opens a device, as ContextDesc::device, after close(), with the present mode that was last chosen if it offers that, else FIFO.
  Expected<void> reopen(const std::string& device);
  /// What uses context() must have released all on the device, which may be lost.
  void close();

  /// Valid from open() or reopen() to close(); the context stays at one address.
  offline::Context& context() { return *context_; }
  Display& display() { return *display_; }
  const std::string& deviceName() const { return deviceName_; }  ///< name and driver
  DeviceMemory memory(double now_s) { return meter_->at(now_s); }

  /// All devices, as findDevices() sorts them.
  std::span<const offline::ListedDevice> devices() const { return devices_; }
  void choose(VkPresentModeKHR mode);

  /// Prints what the validation layer has reported since the last call. Call before close(), too.
  void logValidationMessages();
  bool sawValidationMessage() const { return sawValidationMessage_; }

 private:
  offline::ContextDesc contextDesc(const std::string& device) const;
  Expected<void> create(const std::string& device, VkPresentModeKHR mode);

  const Options& options_;
  Window& window_;
  ImFontAtlas& fonts_;
  // In the order of their dependencies.
  std::optional<offline::Context> context_;
  std::optional<MemoryMeter> meter_;
  std::unique_ptr<Display> display_;

  VkPresentModeKHR mode_;  // as last chosen, whether the device offers it or not
  std::string deviceName_;
  std::vector<offline::ListedDevice> devices_;
  bool sawValidationMessage_ = false;
};

}  // namespace rill::view
