#pragma once
// What water.cpp shows at length, for the other hosts: an engine whose device Rill may borrow, lent.
#include <memory>
#include <rill/device.hpp>
#include <type_traits>

#include "host/engine.hpp"

/// The value, or the end of the program with Rill's message.
template <class T>
T need(rill::Expected<T> result) {
  if (!result) host::fail(result.error().message.c_str());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

struct Lender {
  rill::DeviceRequirements needs;
  host::Engine engine{[this](VkInstance instance, VkPhysicalDevice physicalDevice) {
    need(rill::appendRequired(vkGetInstanceProcAddr, instance, physicalDevice, needs));
    return needs.chain();
  }};

  std::unique_ptr<rill::Device> lend() {
    return need(rill::Device::borrow({.instance = engine.instance,
                                      .physicalDevice = engine.physicalDevice,
                                      .device = engine.device,
                                      .queueFamily = engine.queueFamily,
                                      .getInstanceProcAddr = engine.getInstanceProcAddr,
                                      .enabled = &needs.features}));
  }
};
