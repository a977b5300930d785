#pragma once
// What is on the screen: a picture of the scene, drawn anew when it has changed, and the panels over it, drawn for every frame.
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
  static Expected<std::unique_ptr<Display>> create(offline::Context& context, Window& window, ImFontAtlas& fonts);

  /// Makes the window's images anew where its size, or the present mode, has changed.
  Expected<void> fit(Window::Size size);
  /// Draws the scene for an area of the window, at `scale` of its pixels a side. BadInput where that view cannot be drawn from there: the
  /// old picture stays.
  Expected<void> paint(Session& session, std::string_view view, const CameraView& eye, const Area& area, double scale, double time_s);
  /// Draws the window and shows it; its content goes to `screenshot`, too, where one is asked for.
  Expected<void> show(const ImDrawData& lists, const ImVec4& behind, offline::Image* screenshot);

  /// Device time of the last picture, once it is known: then it is known once.
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
  Buffer shown_;  ///< the picture
  uint32_t shownWidth_ = 0, shownHeight_ = 0;
  Area area_;
  Window::Size size_;
  bool stale_ = true;               ///< the swapchain
  std::optional<uint64_t> timing_;  ///< frame of the picture whose time is to be told
};

}  // namespace rill::view
