#pragma once
// Which way the surface faces in the mean of two spacings to each side: what bends light, so that torn water is no mosaic of lenses. And
// how torn it is: what is white.
#include "gpu/resources.hpp"
#include "render/surface_buffers.hpp"

namespace rill {

/// A mean normal for each sample of a surface.
class MeanFaces {
 public:
  static Expected<MeanFaces> create(Device& device);

  /// A word a sample that holds fluid, as unpackMean() of the shaders reads it, in view space. Its direction is the mean of the water that
  /// the sample is of; it is the shorter the more the faces around differ, whatever their depth: about 1 on an even surface, a half at a
  /// straight silhouette, a tenth on a lone ball. What other samples have is not defined.
  BufferRef addTo(Graph& graph, const SurfaceBuffers& surface) const;

 private:
  const ComputePipeline *faces_[2] = {}, *torn_[2] = {};  ///< along rows, along columns
};

}  // namespace rill
