// The frame of a Vulkan layer: it finds the next layer's functions and hands on what the layer does not replace. Supports one instance
// and one device.
#pragma once
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan_core.h>

namespace rill::layer {

/// The layer's own function of that name ("vkCreateBuffer"), or null. Each layer defines it.
PFN_vkVoidFunction replacement(const char* name);

/// Called once the instance exists. Each layer defines it, to find what it calls by nextInstanceProc(): later the loader may give it
/// the first function of all layers instead.
void instanceCreated(VkInstance instance);

/// Called once the device exists. Each layer defines it, to find what it calls by nextDeviceProc().
void deviceCreated(VkDevice device);

/// Functions of the next layer or the driver.
PFN_vkVoidFunction nextInstanceProc(VkInstance instance, const char* name);
PFN_vkVoidFunction nextDeviceProc(VkDevice device, const char* name);

}  // namespace rill::layer
