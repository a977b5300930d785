#pragma once
#include "rill/device.hpp"

namespace rill {

struct InstanceTable;

/// Checks version, subgroup operations and texel formats. Fails with NoDevice, naming what is missing.
Expected<void> checkDevice(const InstanceTable& instance, VkPhysicalDevice device);

/// Checks the features passed to vkCreateDevice. Fails with NoDevice, naming what is missing.
Expected<void> checkEnabled(const VkPhysicalDeviceFeatures2& enabled);

}  // namespace rill
