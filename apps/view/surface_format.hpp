#pragma once
// How a window's images are written: their format, and whether the picture must be converted for it.
#include <vulkan/vulkan_core.h>

#include <span>

#include "rill/expected.hpp"

namespace rill::view {

/// Picture and panels are blended in 8-bit sRGB values, in an image of the format `canvas`.
struct SurfaceFormat {
  VkFormat canvas = VK_FORMAT_UNDEFINED;  ///< B8G8R8A8_UNORM or R8G8B8A8_UNORM
  VkFormat format = VK_FORMAT_UNDEFINED;  ///< of the window's images
  VkColorSpaceKHR space = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
  bool encodes = false;  ///< the format encodes sRGB itself, so that linear values must be written

  /// Whether the window's image is the canvas; otherwise it is copied there.
  bool isCanvas() const { return canvas == format; }
};

/// The first of these that the window offers in the sRGB color space: 8-bit UNORM, 8-bit SRGB, 10-bit UNORM. NoDevice if it offers none.
Expected<SurfaceFormat> chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> offered);

}  // namespace rill::view
