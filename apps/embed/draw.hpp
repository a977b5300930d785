#pragma once
// Helpers of the programs that render: importing images into a graph, and the camera as a FluidView.
#include <cmath>
#include <rill/fluid_renderer.hpp>

#include "host/camera.hpp"
#include "host/engine.hpp"

inline rill::ImageRef importTarget(rill::Graph& graph, const char* name, const host::Image& image, rill::Use use) {
  return graph.import(name, {image.handle, {image.format, image.width, image.height}, use, use});
}

/// A view of the whole image, with reversed depth.
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
