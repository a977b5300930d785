#pragma once
// When a frame replaces the one that the display shows.
#include <vulkan/vulkan_core.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rill/expected.hpp"

namespace rill::view {

/// "fifo", "mailbox", "immediate" or "fifo-relaxed"; empty for other modes, which the viewer does not offer.
std::string_view presentModeName(VkPresentModeKHR mode);
std::optional<VkPresentModeKHR> presentModeNamed(std::string_view name);
/// All names, separated by ", ".
std::string presentModeNames();
/// BadInput, naming --present and the modes that the window offers, unless `mode` is one of them.
Expected<void> checkPresentMode(VkPresentModeKHR mode, std::span<const VkPresentModeKHR> offered);

}  // namespace rill::view
