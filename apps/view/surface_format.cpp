#include "view/surface_format.hpp"

#include <string>

namespace rill::view {

Expected<SurfaceFormat> chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> offered) {
  constexpr VkColorSpaceKHR kSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
  constexpr VkFormat kCopied = VK_FORMAT_R8G8B8A8_UNORM;  // blending is mandatory for it, not for 10-bit formats
  constexpr struct {
    VkFormat format, canvas;
    bool encodes;
    int preference;
  } kFormats[] = {{VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM, false, 0},
                  {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM, false, 0},
                  {VK_FORMAT_A8B8G8R8_UNORM_PACK32, kCopied, false, 1},
                  {VK_FORMAT_B8G8R8A8_SRGB, kCopied, true, 1},
                  {VK_FORMAT_R8G8B8A8_SRGB, kCopied, true, 1},
                  {VK_FORMAT_A8B8G8R8_SRGB_PACK32, kCopied, true, 1},
                  {VK_FORMAT_A2B10G10R10_UNORM_PACK32, kCopied, false, 2},
                  {VK_FORMAT_A2R10G10B10_UNORM_PACK32, kCopied, false, 2}};
  SurfaceFormat best;
  int preference = 3;
  std::string found;
  for (const VkSurfaceFormatKHR& offer : offered) {
    for (const auto& row : kFormats)
      if (row.format == offer.format && offer.colorSpace == kSpace && row.preference < preference) {
        best = {row.canvas, row.format, kSpace, row.encodes};
        preference = row.preference;
      }
    found += (found.empty() ? "" : ", ") + std::to_string(offer.format) + " in color space " + std::to_string(offer.colorSpace);
  }
  if (preference < 3) return best;
  return Error{ErrorKind::NoDevice, "the window offers the formats " + (found.empty() ? "(none)" : found) +
                                        "; expected 8-bit UNORM, 8-bit SRGB or 10-bit UNORM in the color space SRGB_NONLINEAR"};
}

}  // namespace rill::view
