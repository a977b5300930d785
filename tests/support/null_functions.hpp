#pragma once
// The parts of NullVulkan: each knows some functions by their names, and null for others.
#include <string_view>

#include "support/null_vulkan.hpp"

/// In a function that looks `name` up: a function of Vulkan, and what stands for it.
#define RILL_NULL_FUNCTION(vulkan, function) \
  if (name == #vulkan) return reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_##vulkan>(function));

namespace rill::test {

extern NullVulkan* current;  ///< Vulkan functions carry no user pointer

void nullFeatures(VkPhysicalDevice, VkPhysicalDeviceFeatures2* out);
PFN_vkVoidFunction nullProperty(std::string_view name);
PFN_vkVoidFunction nullCommand(std::string_view name);

}  // namespace rill::test
