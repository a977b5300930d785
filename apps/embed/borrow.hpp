#pragma once
// What water.cpp shows at length, for the other hosts: an engine whose device Rill may borrow, lent.
#include <memory>
#include <rill/device.hpp>
#include <rill/fluid_renderer.hpp>

#include "host/camera.hpp"
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
                                      .enabled = needs.chain()}));
  }
};

inline rill::ImageRef importTarget(rill::Graph& graph, const char* name, const host::Image& image, rill::Use use) {
  return graph.import(name, {image.handle, {image.format, image.width, image.height}, use, use});
}

/// A view of the whole picture, reversed depth.
inline rill::FluidView lookAt(const float (&eye)[3], const float (&target)[3], uint32_t width, uint32_t height) {
  const host::Matrix view = host::lookAt(eye, target), projection = host::perspective(40, float(width) / float(height), 0.1f);
  rill::FluidView out;
  out.view = rill::Float4x4::from(view.m[0]);
  out.projection = rill::Float4x4::from(projection.m[0]);
  out.width = width;
  out.height = height;
  out.focus_m = std::hypot(eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]);
  return out;
}
