#pragma once
#include <vulkan/vulkan_core.h>

namespace rill::test {

/// Of libvulkan, opened at run time; null where there is none.
PFN_vkGetInstanceProcAddr loaderFunction();

}  // namespace rill::test
