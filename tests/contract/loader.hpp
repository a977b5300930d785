#pragma once
#include <vulkan/vulkan_core.h>

namespace rill::test {

/// Of libvulkan, opened at run time; null without a loader.
PFN_vkGetInstanceProcAddr loaderFunction();

}  // namespace rill::test
