#pragma once
// Which way the surface faces in the mean over two spacings: what bends the light that goes through torn water.
#include "gpu/resources.hpp"
#include "render/surface_buffers.hpp"

namespace rill {

class MeanFaces {
 public:
  static Expected<MeanFaces> create(Device& device);

  /// Two words a sample: depth as in SurfaceBuffers::samples, infinite where there is no fluid; the mean normal, as unpackMean() reads it
  /// (view space, the shorter the more the faces around differ).
  BufferRef addTo(Graph& graph, const SurfaceBuffers& surface) const;

 private:
  const ComputePipeline* along_[2] = {};
};

}  // namespace rill
