#pragma once
// Post-processing from linear light to a picture: exposure, tone curve, antialiasing.
#include "gpu/resources.hpp"
#include "rill/graph.hpp"

namespace rill {

class Finish {
 public:
  /// The device must have the shaders of engine/views.
  static Expected<Finish> create(Device& device);

  /// `color`: linear light, width x height; multiplied by two to the power of `exposure_stops`. RGBA8 in sRGB, rows from the top.
  BufferRef addTo(Graph& graph, ImageRef color, uint32_t width, uint32_t height, double exposure_stops = 0) const;

 private:
  const ComputePipeline *tone_ = nullptr, *antialias_ = nullptr;
};

}  // namespace rill
