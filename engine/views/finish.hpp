#pragma once
// Post-processing from linear light to a picture: exposure, tone curve, antialiasing.
#include "gpu/resources.hpp"
#include "rill/graph.hpp"

namespace rill {

class Finish {
 public:
  /// The device must have the shaders of engine/views. `storageReads`: never uses texel buffers; the bits are the same.
  static Expected<Finish> create(Device& device, bool storageReads = false);

  /// `color`: linear light, width x height; multiplied by two to the power of `exposure_stops`. RGBA8 in sRGB, rows from the top.
  BufferRef addTo(Graph& graph, ImageRef color, uint32_t width, uint32_t height, double exposure_stops = 0) const;
  /// The antialiasing alone, of a picture in RGBA8.
  BufferRef smoothed(Graph& graph, BufferRef aliased, uint32_t width, uint32_t height) const;

 private:
  const ComputePipeline *tone_ = nullptr, *search_ = nullptr, *antialias_ = nullptr;
};

}  // namespace rill
