#pragma once
// Which way the surface faces in the mean of two spacings to each side: what bends light, so that torn water is no mosaic of lenses.
#include "gpu/resources.hpp"
#include "render/surface_buffers.hpp"

namespace rill {

/// A mean normal for each sample of a surface.
class MeanFaces {
 public:
  static Expected<MeanFaces> create(Device& device);

  /// A word a sample that holds fluid, as unpackMean() of the shaders reads it: in view space, the shorter the more the faces around
  /// differ; about 1 on an even surface, a half at a straight silhouette, a tenth on a lone ball. What other samples have is not defined.
  BufferRef addTo(Graph& graph, const SurfaceBuffers& surface) const;

 private:
  const ComputePipeline* along_[2] = {};
};

}  // namespace rill
