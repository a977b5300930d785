#pragma once
#include "rill/device.hpp"

namespace rill {

struct InstanceTable;

/// Checks version, features, subgroups, texel formats and the limits that the built-in compute shaders need. Fails with NoDevice and a line
/// for each item that is missing, with what would help.
Expected<void> checkDevice(const InstanceTable& instance, VkPhysicalDevice device);

/// Checks the features passed to vkCreateDevice. Fails with NoDevice and a line for each that is missing.
Expected<void> checkEnabled(const VkPhysicalDeviceFeatures2& enabled);

}  // namespace rill
