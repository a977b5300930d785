#pragma once
// The device setup of water.cpp, for the other programs: an engine with a device that Rill can borrow.
#include <rill/device.hpp>
#include <type_traits>

#include "host/engine.hpp"

/// Returns the value, or prints Rill's error message and exits.
template <class T>
T need(rill::Expected<T> result) {
  if (!result) host::fail(result.error().message.c_str());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

struct RillHost {
  rill::DeviceRequirements needs;
  host::Engine engine{[this](VkInstance instance, VkPhysicalDevice physicalDevice) {
    need(rill::appendRequired(vkGetInstanceProcAddr, instance, physicalDevice, needs));
    return needs.chain();
  }};

  rill::Device borrowDevice() {
    return need(rill::Device::borrow({.instance = engine.instance,
                                      .physicalDevice = engine.physicalDevice,
                                      .device = engine.device,
                                      .queueFamily = engine.queueFamily,
                                      .getInstanceProcAddr = engine.getInstanceProcAddr,
                                      .enabled = &needs.features}));
  }
};
