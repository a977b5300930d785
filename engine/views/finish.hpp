#pragma once
// Post-processing from linear light to a picture: tone curve, sRGB encoding, antialiasing.
#include "gpu/resources.hpp"
#include "rill/graph.hpp"

namespace rill {

class Finish {
 public:
  /// The device must have the shaders of engine/views.
  static Expected<Finish> create(Device& device);

  /// `color`: linear light, width x height. RGBA8 in sRGB, rows from the top.
  BufferRef addTo(Graph& graph, ImageRef color, uint32_t width, uint32_t height) const;

 private:
  const ComputePipeline *tone_ = nullptr, *antialias_ = nullptr;
};

}  // namespace rill
