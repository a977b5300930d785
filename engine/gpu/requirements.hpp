#pragma once
#include "rill/device.hpp"

namespace rill {

struct InstanceTable;

/// Version, subgroup operations and texel formats of a physical device. NoDevice names what is missing.
Expected<void> checkDevice(const InstanceTable& instance, VkPhysicalDevice device);

/// The features that a host says it enabled at vkCreateDevice. NoDevice names what is missing.
Expected<void> checkEnabled(const VkPhysicalDeviceFeatures2& enabled);

}  // namespace rill
