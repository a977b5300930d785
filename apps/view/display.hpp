#pragma once
// Draws the window: the image of the scene, rendered when it changes, and the panels over it, rendered in every frame.
#include <memory>
#include <optional>
#include <string>

#include "rill/offline.hpp"
#include "view/session.hpp"
#include "view/swapchain.hpp"
#include "view/window.hpp"
#include "view/window_pass.hpp"

namespace rill::view {

class Display {
 public:
  static Expected<std::unique_ptr<Display>> create(offline::Context& context, Window& window, ImFontAtlas& fonts, VkPresentModeKHR mode);

  /// Recreates the swapchain where the window's size or the present mode has changed.
  Expected<void> fit(Window::Size size);
  /// Renders the scene for an area of the window, at `scale` times its resolution per side. BadInput where the view cannot
  /// be drawn from this camera; the previous image stays.
  Expected<void> paint(Session& session, std::string_view view, const CameraView& eye, const Area& area, double scale, double time_s);
  /// Draws and presents the window; copies its content to `screenshot` unless that is null.
  Expected<void> show(const ImDrawData& lists, const ImVec4& behind, offline::Image* screenshot);

  /// Device time of the last image, returned once after it was measured.
  std::optional<double> pictureSeconds();
  std::span<const Timing> pictureTimings() const { return picture_.timings(); }
  std::span<const PassReport> pictureReport() const { return picture_.report(); }
  const Graph& pictureGraph() const { return picture_; }
  const Graph& windowGraph() const { return window_; }
  uint64_t pictureBytes() const { return shown_.size(); }

  std::span<const VkPresentModeKHR> modes() const { return swapchain_->modes(); }
  VkPresentModeKHR mode() const { return swapchain_->mode(); }
  void choose(VkPresentModeKHR mode);

 private:
  explicit Display(offline::Context& context) : context_(context) {}

  offline::Context& context_;
  std::unique_ptr<Swapchain> swapchain_;
  std::unique_ptr<WindowPass> pass_;
  Graph picture_, window_;
  Buffer shown_;  ///< the image of the scene
  uint32_t shownWidth_ = 0, shownHeight_ = 0;
  Area area_;
  Window::Size size_;
  bool stale_ = true;               ///< the swapchain must be recreated
  std::optional<uint64_t> timing_;  ///< frame of the image whose time is not returned yet
};

}  // namespace rill::view
